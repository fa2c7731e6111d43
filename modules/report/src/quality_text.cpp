// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/report/quality_report.h>

#include "formatted.h"

namespace pcl_als {
namespace {

/// "+0.0123", or a dash for an unknown number; a zero has no sign.
std::string metres(double value, int digits = 4) {
  if (!std::isfinite(value)) return "-";
  const std::string text = formatted("%+.*f", digits, value);
  return text.find_first_of("123456789") == std::string::npos ? text.substr(1) : text;
}
std::string size(double value, int digits = 4) {
  return std::isfinite(value) ? formatted("%.*f", digits, value) : "-";
}

/// Calls row(label, block, pair) for every pair of the report, before and after together.
template <typename Row>
void forEachPair(const QualityReport& report, Row row) {
  for (const CheckedPair& pair : report.block.pairs) {
    const CheckedPair* before = pairBefore(report, pair);
    if (before != nullptr) row("before", *before);
    row(report.before ? "after" : "", pair);
  }
}

/// Columns as wide as need be.
std::string textOf(const QualityTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& cell : table.columns) widths.push_back(cell.size());
  for (const auto& row : table.rows) {
    const std::size_t cells = row.size() < widths.size() ? row.size() - 1 : row.size();
    for (std::size_t i = 0; i < cells; ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  const auto line = [&](const std::vector<std::string>& row) {
    std::string text = "|";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - std::min(widths[i], row[i].size()), ' ');
      text += ' ' + (i == 0 ? row[i] + padding : padding + row[i]) + " |";
    }
    return text + '\n';
  };
  std::string text = '\n' + table.caption + "\n\n" + line(table.columns) + '|';
  for (const std::size_t width : widths) text += std::string(width + 2, '-') + '|';
  text += '\n';
  for (const auto& row : table.rows) text += line(row);
  return text;
}

/// "a & b", and which set where there are two.
std::string labelOf(const char* set, const CheckedPair& pair) {
  return pair.a + " & " + pair.b + (*set == 0 ? "" : std::string(" ") + set);
}

std::string withStd(double value, double std, int digits = 4) {
  return metres(value, digits) + " (" + size(std, digits) + ")";
}

QualityTable verticalTable(const QualityReport& report) {
  QualityTable table{"Height differences a - b on smooth level single-return ground, m",
                     {"pair", "overlap m2", "places", "mean (std)", "median", "RMSDz",
                      "RMS of cells", "95 %", "level"},
                     {},
                     {}};
  forEachPair(report, [&](const char* set, const CheckedPair& pair) {
    const OffsetSummary& v = pair.assessment.vertical;
    std::vector<std::string> row{labelOf(set, pair), formatted("%.0f", pair.overlap_area),
                                 std::to_string(v.count)};
    if (!judged(pair)) {
      row.push_back(pair.assessment.reason);
    } else {
      for (const std::string& cell :
           {withStd(v.mean, v.std_of_mean), metres(v.median), size(v.rms),
            size(pair.assessment.vertical_cells.rms), size(v.percentile_95),
            levelName(pair.assessment.quality_level)})
        row.push_back(cell);
    }
    const auto& level = pair.assessment.quality_level;
    const bool given = std::string(set) != "before";
    if (given && judged(pair) && !(level && *level <= report.quality_level))
      table.failed.push_back(table.rows.size());
    table.rows.push_back(row);
  });
  return table;
}

/// Table 3 of Habib et al. 2011.
QualityTable alignmentTable(const QualityReport& report) {
  QualityTable table{
      "Rigid movement of a onto b about the centroid of their overlap (ICPatch), "
      "with standard deviations",
      {"pair", "XT m", "YT m", "ZT m", "omega mdeg", "phi mdeg", "kappa mdeg"},
      {}};
  forEachPair(report, [&](const char* set, const CheckedPair& pair) {
    if (!pair.alignment) return;
    const PatchAlignmentResult& r = *pair.alignment;
    std::vector<std::string> row{labelOf(set, pair)};
    if (!r.hasConverged()) row.push_back(std::string(toString(r.status)) + ": " + r.message);
    for (int i = 0; r.hasConverged() && i < PatchAlignmentResult::kParameters; ++i) {
      const double unit = i < 3 ? 1.0 : 1e-3 * kRadiansPerDegree;
      const double value = i < 3 ? r.motion.shift[i] : r.motion.rotation[i - 3];
      row.push_back(r.parameters[static_cast<std::size_t>(i)].determined
                        ? withStd(value / unit, r.standardDeviation(i) / unit, i < 3 ? 4 : 2)
                        : "not determined");
    }
    table.rows.push_back(row);
  });
  return table;
}

QualityTable shiftTable(const QualityReport& report) {
  QualityTable table{
      "Normal distances a - b of all smooth surfaces; movement of a onto b that slopes over 10 "
      "degrees show, m",
      {"pair", "places", "mean", "RMS", "slopes", "east (std)", "north (std)", "up (std)"},
      {}};
  forEachPair(report, [&](const char* set, const CheckedPair& pair) {
    if (!judged(pair)) return;
    const OffsetSummary& n = pair.assessment.normal;
    const HorizontalShift& h = pair.assessment.horizontal;
    std::vector<std::string> row{labelOf(set, pair), std::to_string(n.count), metres(n.mean),
                                 size(n.rms), std::to_string(h.count)};
    if (!h.determined) row.push_back("not determined: " + h.reason);
    for (int i = 0; h.determined && i < 3; ++i) row.push_back(withStd(h.shift[i], h.std[i]));
    table.rows.push_back(row);
  });
  return table;
}

std::string arcsec(const OverlapTrends::Roll& roll) {
  return roll.determined ? withStd(roll.value / kRadiansPerArcsec, roll.std / kRadiansPerArcsec, 1)
                         : "-";
}

QualityTable trendTable(const QualityReport& report) {
  QualityTable table{
      "How height differences change: across the overlap (right of a's flight), along it, with "
      "time and scan angle of a",
      {"pair", "flown", "across mm/100 m", "along mm/100 m", "time mm/s", "angle mm/deg",
       "as roll error, arcsec"},
      {}};
  const auto trend = [](const Trend& t, double factor) {
    return t.determined ? withStd(factor * t.slope, factor * t.std, 2) : std::string("-");
  };
  forEachPair(report, [&](const char* set, const CheckedPair& pair) {
    if (!judged(pair)) return;
    const OverlapTrends& t = pair.assessment.trends;
    std::string roll = arcsec(t.roll);
    if (t.relation == FlightRelation::parallel) roll = "a - b " + roll;
    if (t.roll_b.determined) roll = "a " + roll + ", b " + arcsec(t.roll_b);
    table.rows.push_back({labelOf(set, pair), toString(t.relation), trend(t.across, 1e5),
                          trend(t.along, 1e5), trend(t.time, 1e3), trend(t.scan_angle, 1e3), roll});
  });
  return table;
}

std::string triangleText(const QualityReport& report) {
  if (report.block.triangles.empty()) return {};
  std::string text =
      "\nClosure of height differences around three strips, on the ground that all three cover, "
      "m\n\n";
  constexpr std::size_t kMaximumRows = 20;
  const auto& all = report.block.triangles;
  for (std::size_t i = 0; i < std::min(kMaximumRows, all.size()); ++i)
    text += formatted("  %s, %s, %s: %s (std %s), %zu cells\n", all[i].a.c_str(), all[i].b.c_str(),
                      all[i].c.c_str(), metres(all[i].closure).c_str(), size(all[i].std).c_str(),
                      all[i].cells);
  if (all.size() > kMaximumRows) text += formatted("  … and %zu more\n", all.size() - kMaximumRows);
  return text;
}

std::optional<QualityTable> controlTable(const QualityReport& report) {
  if (!report.block.control) return std::nullopt;
  QualityTable table{"Heights of strips above control, m",
                     {"strip", "points", "mean", "sd", "RMSE", "largest"},
                     {}};
  const auto row = [&](const std::string& strip, const char* set, const OffsetSummary* s) {
    if (s == nullptr) return;
    table.rows.push_back({strip + (*set == 0 ? "" : std::string(" ") + set),
                          std::to_string(s->count), metres(s->mean), size(s->std), size(s->rms),
                          size(s->largest)});
  };
  const auto both = [&](const std::string& strip, auto find) {
    if (report.before && report.before->control)
      row(strip, "before", find(*report.before->control));
    row(strip, report.before ? "after" : "", find(*report.block.control));
  };
  for (const auto& of_strip : report.block.control->strips) {
    both(of_strip.strip, [&](const ControlAssessment& control) -> const OffsetSummary* {
      for (const auto& other : control.strips)
        if (other.strip == of_strip.strip) return &other.offsets;
      return nullptr;
    });
  }
  both("all", [](const ControlAssessment& control) { return &control.all; });
  return table;
}

/// Assessment of control by the standards; without a point there are no figures.
std::string figuresOf(const ControlAssessment& control) {
  std::string text =
      formatted("%zu points, %zu of no strip", control.points, control.unseen.size());
  if (!control.far.empty())
    text += formatted(", %zu more than %s m above or below the strips", control.far.size(),
                      shortText(control.distance_limit).c_str());
  if (!control.accuracy) return text + ": no figures\n";
  const VerticalAccuracy& accuracy = *control.accuracy;
  const std::string of_class = control.no_class.empty()
                                   ? formatted("class %.0f cm", accuracy.class_cm)
                                   : "no class: " + control.no_class;
  text += formatted(
      ". RMSE_V %.4f m (%s) with %.4f m for the survey of the points%s\n  [%s]\n  older: NVA at "
      "95 %% = 1.96 RMSEz = %.4f m [%s]\n  absolute accuracy %s [%s]\n",
      accuracy.rmse_v, of_class.c_str(), accuracy.survey,
      control.survey_known ? "" : " (assumed: the file gives none)", kPositionalStandard,
      accuracy.nva_95, kOlderPositionalStandard, levelName(control.quality_level).c_str(),
      kAbsoluteSpecification);
  if (!accuracy.enough_points)
    text += formatted("  fewer than the %zu check points that the standard asks for\n",
                      kFewestCheckPoints);
  const HorizontalShift& shift = control.shift;
  return text + "  movement of the strips onto control that slopes show: " +
         (shift.determined ? "east " + withStd(shift.shift.x(), shift.std.x(), 3) + " m, north " +
                                 withStd(shift.shift.y(), shift.std.y(), 3) + " m\n"
                           : "not determined (" + shift.reason + ")\n");
}

std::string controlFigures(const QualityReport& report) {
  if (!report.block.control) return {};
  const bool both = report.before && report.before->control;
  return (both ? "\nBefore: " + figuresOf(*report.before->control) : std::string()) +
         (report.before ? "\nAfter: " : "\n") + figuresOf(*report.block.control);
}

/// How many of all overlapping pairs keep the level, and what is known of the others.
std::string pairsText(const QualityReport& report) {
  const QualityLevelLimits& limits =
      qualityLevels()[static_cast<std::size_t>(report.quality_level)];
  const auto& pairs = report.block.pairs;
  const auto kept = std::count_if(pairs.begin(), pairs.end(), [&](const CheckedPair& pair) {
    return judged(pair) && !pair.of_one_pass &&
           pair.assessment.vertical.rms <= limits.swath_overlap_rmsdz;
  });
  const PairCounts counts = countPairs(pairs);
  std::string text = formatted("\n%zu of %zu pairs keep QL%d: RMSDz at most %.2f m [%s]\n",
                               static_cast<std::size_t>(kept), counts.all(), report.quality_level,
                               limits.swath_overlap_rmsdz, kSwathSpecification);
  for (const std::string& sentence : unmeasuredPairs(pairs)) text += "  " + sentence + '\n';
  if (counts.too_small > 0)
    text += "  " + counted(counts.too_small, "overlap") + " too small to be measured\n";
  return text;
}

}  // namespace

std::string levelName(const std::optional<int>& level) {
  return level ? formatted("QL%d", *level) : "none";
}

bool judged(const CheckedPair& pair) {
  return pair.assessment.status == PairAssessment::Status::judged;
}

const CheckedPair* pairBefore(const QualityReport& report, const CheckedPair& like) {
  if (!report.before) return nullptr;
  for (const CheckedPair& pair : report.before->pairs)
    if (pair.a == like.a && pair.b == like.b) return &pair;
  return nullptr;
}

bool hasAnswer(const CheckedBlock& block) {
  return (block.control && block.control->points > 0) ||
         std::any_of(block.pairs.begin(), block.pairs.end(), judged);
}

std::string whyUnreliable(const CheckedBlock& block) {
  if (hasAnswer(block)) return {};
  for (const CheckedPair& pair : block.pairs) {
    if (!pair.assessment.reason.empty())
      return "strips " + pair.a + " and " + pair.b + ": " + pair.assessment.reason;
  }
  return "no strip covers a control point";
}

std::vector<QualityTable> qualityTables(const QualityReport& report) {
  std::vector<QualityTable> tables = {verticalTable(report), alignmentTable(report),
                                      shiftTable(report), trendTable(report)};
  if (auto control = controlTable(report)) tables.push_back(std::move(*control));
  return tables;
}

std::string qualityText(const QualityReport& report) {
  std::string text = textOf(verticalTable(report)) + textOf(alignmentTable(report)) +
                     textOf(shiftTable(report)) + textOf(trendTable(report)) + triangleText(report);
  if (const auto control = controlTable(report)) text += textOf(*control);
  text += controlFigures(report);
  text += pairsText(report);
  for (const Warning& warning : report.block.warnings) text += "\nwarning: " + warning.text + '\n';
  return text;
}

}  // namespace pcl_als
