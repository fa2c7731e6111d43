// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include <pcl_als/common/system_parameters.h>

#include "command_line.h"
#include "quality_report.h"

namespace pcl_als::app {
namespace {

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char line[512];
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(line, sizeof line, pattern, values);
  va_end(values);
  return line;
}

/// "+0.0123", or a dash for what is unknown.
std::string metres(double value, int digits = 4) {
  return std::isfinite(value) ? format("%+.*f", digits, value) : "-";
}
std::string size(double value, int digits = 4) {
  return std::isfinite(value) ? format("%.*f", digits, value) : "-";
}

const CheckedPair* pairIn(const CheckedBlock& block, const CheckedPair& like) {
  for (const CheckedPair& pair : block.pairs)
    if ((pair.a == like.a && pair.b == like.b)) return &pair;
  return nullptr;
}

std::string nameOf(const CheckedPair& pair) {
  return pair.a + " & " + pair.b;
}

bool judged(const CheckedPair& pair) {
  return pair.assessment.status == PairAssessment::Status::judged;
}

/// Calls row(label, block, pair) for every pair of the report, before and after together.
template <typename Row>
void forEachPair(const QualityReport& report, Row row) {
  for (const CheckedPair& pair : report.block.pairs) {
    const CheckedPair* before = report.before ? pairIn(*report.before, pair) : nullptr;
    if (before != nullptr) row("before", *before);
    row(report.before ? "after" : "", pair);
  }
}

std::string verticalTable(const QualityReport& report) {
  std::string text = format(
      "\nHeight differences a - b on smooth level single-return ground, m\n\n"
      "| %-19s | %-6s | overlap m2 | places |    mean (std) | median |  RMSDz | cells RMS |   95 "
      "%% | "
      "level |\n"
      "|---------------------|--------|------------|--------|------------------|--------|--------|-"
      "----------|--------|-------|\n",
      "pair", "");
  forEachPair(report, [&](const char* label, const CheckedPair& pair) {
    const OffsetSummary& v = pair.assessment.vertical;
    text += format("| %-19s | %-6s | %10.0f | %6zu | ", nameOf(pair).c_str(), label,
                   pair.overlap_area, v.count);
    if (!judged(pair)) {
      text += pair.assessment.reason + "\n";
      return;
    }
    text += format("%7s (%s) | %6s | %6s | %9s | %6s | %-5s |\n", metres(v.mean).c_str(),
                   size(v.std_of_mean).c_str(), metres(v.median).c_str(), size(v.rms).c_str(),
                   size(pair.assessment.vertical_cells.rms).c_str(), size(v.percentile_95).c_str(),
                   levelName(pair.assessment.quality_level).c_str());
  });
  return text;
}

/// The paper's Table 3.
std::string alignmentTable(const QualityReport& report) {
  std::string text = format(
      "\nRigid movement of a onto b about the centroid of their overlap (ICPatch), m and 0.001 "
      "deg, "
      "with standard deviations\n\n"
      "| %-19s | %-6s | XT              | YT              | ZT              | omega        | phi  "
      "        | kappa        |\n"
      "|---------------------|--------|-----------------|-----------------|-----------------|------"
      "-"
      "-------|--------------|--------------|\n",
      "pair", "");
  forEachPair(report, [&](const char* label, const CheckedPair& pair) {
    if (!pair.alignment) return;
    const PatchAlignmentResult& r = *pair.alignment;
    text += format("| %-19s | %-6s | ", nameOf(pair).c_str(), label);
    if (!r.hasConverged()) {
      text += std::string(toString(r.status)) + ": " + r.message + " |\n";
      return;
    }
    for (int i = 0; i < PatchAlignmentResult::kParameters; ++i) {
      const int width = i < 3 ? 15 : 12;
      std::string cell = "not determined";
      if (r.parameters[static_cast<std::size_t>(i)].determined) {
        const double thousandth = 1e-3 * kRadiansPerDegree;
        cell = i < 3 ? format("%+.4f (%.4f)", r.motion.shift[i], r.standardDeviation(i))
                     : format("%+.2f (%.2f)", r.motion.rotation[i - 3] / thousandth,
                              r.standardDeviation(i) / thousandth);
      }
      text += format("%*s | ", width, cell.c_str());
    }
    text.back() = '\n';
  });
  return text;
}

std::string shiftTable(const QualityReport& report) {
  std::string text = format(
      "\nNormal distances a - b of all smooth surfaces; movement of a onto b that slopes over 10 "
      "degrees show, m\n\n"
      "| %-19s | %-6s | places |    mean |    RMS | slopes |  east (std)     |  north (std)    |  "
      "up "
      "(std)       |\n"
      "|---------------------|--------|--------|---------|--------|--------|------------------|----"
      "--------------|------------------|\n",
      "pair", "");
  forEachPair(report, [&](const char* label, const CheckedPair& pair) {
    if (!judged(pair)) return;
    const OffsetSummary& n = pair.assessment.normal;
    const HorizontalShift& h = pair.assessment.horizontal;
    text += format("| %-19s | %-6s | %6zu | %7s | %6s | %6zu | ", nameOf(pair).c_str(), label,
                   n.count, metres(n.mean).c_str(), size(n.rms).c_str(), h.count);
    if (!h.determined) {
      text += "not determined: " + h.reason + " |\n";
      return;
    }
    for (int i = 0; i < 3; ++i)
      text += format("%7s (%s) | ", metres(h.shift[i]).c_str(), size(h.std[i]).c_str());
    text += '\n';
  });
  return text;
}

std::string arcsec(const OverlapTrends::Roll& roll) {
  if (!roll.determined) return "-";
  return format("%+.1f (%.1f)", roll.value / kRadiansPerArcsec, roll.std / kRadiansPerArcsec);
}

std::string trendTable(const QualityReport& report) {
  std::string text = format(
      "\nHow height differences change: across the overlap (right of a's flight), along it, with "
      "time, with scan angle\n\n"
      "| %-19s | %-6s | flown    | across mm/100 m | along mm/100 m | time mm/s     | angle mm/deg "
      " | "
      "roll error arcsec |\n"
      "|---------------------|--------|----------|-----------------|----------------|--------------"
      "-|---------------|-------------------|\n",
      "pair", "");
  const auto trend = [](const Trend& t, double factor) {
    return t.determined ? format("%+.2f (%.2f)", factor * t.slope, factor * t.std)
                        : std::string("-");
  };
  forEachPair(report, [&](const char* label, const CheckedPair& pair) {
    if (!judged(pair)) return;
    const OverlapTrends& t = pair.assessment.trends;
    std::string roll = arcsec(t.roll);
    if (t.relation == FlightRelation::parallel) roll = "a - b: " + roll;
    if (t.roll_b.determined) roll = "a " + roll + ", b " + arcsec(t.roll_b);
    text += format("| %-19s | %-6s | %-8s | %15s | %14s | %13s | %13s | %s |\n",
                   nameOf(pair).c_str(), label, toString(t.relation), trend(t.across, 1e5).c_str(),
                   trend(t.along, 1e5).c_str(), trend(t.time, 1e3).c_str(),
                   trend(t.scan_angle, 1e3).c_str(), roll.c_str());
  });
  return text;
}

std::string triangleTable(const QualityReport& report) {
  if (report.block.triangles.empty()) return {};
  std::string text =
      "\nClosure of height differences around three strips, on the ground that all three see, "
      "m\n\n";
  constexpr std::size_t kMost = 20;
  const auto& all = report.block.triangles;
  for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i)
    text += format("  %s, %s, %s: %s (std %s), %zu cells\n", all[i].a.c_str(), all[i].b.c_str(),
                   all[i].c.c_str(), metres(all[i].closure).c_str(), size(all[i].std).c_str(),
                   all[i].cells);
  if (all.size() > kMost) text += format("  … and %zu more\n", all.size() - kMost);
  return text;
}

void controlRow(const char* label, const char* strip, const OffsetSummary& s, std::string& text) {
  text += format("| %-15s | %-6s | %6zu | %7s | %6s | %6s | %7s |\n", strip, label, s.count,
                 metres(s.mean).c_str(), size(s.std).c_str(), size(s.rms).c_str(),
                 size(s.largest).c_str());
}

std::string controlTable(const QualityReport& report) {
  if (!report.block.control) return {};
  std::string text = format(
      "\nHeights of strips above control, m\n\n"
      "| %-15s | %-6s | points |    mean |     sd |   RMSE | largest |\n"
      "|-----------------|--------|--------|---------|--------|--------|---------|\n",
      "strip", "");
  const auto both = [&](const char* strip, auto find) {
    if (report.before && report.before->control) {
      const OffsetSummary* before = find(*report.before->control);
      if (before != nullptr) controlRow("before", strip, *before, text);
    }
    const OffsetSummary* after = find(*report.block.control);
    if (after != nullptr) controlRow(report.before ? "after" : "", strip, *after, text);
  };
  for (const auto& of_strip : report.block.control->strips) {
    both(of_strip.strip.c_str(), [&](const ControlAssessment& control) -> const OffsetSummary* {
      for (const auto& other : control.strips)
        if (other.strip == of_strip.strip) return &other.offsets;
      return nullptr;
    });
  }
  both("all", [](const ControlAssessment& control) { return &control.all; });
  const auto figures = [&](const char* label, const ControlAssessment& control) {
    const VerticalAccuracy& accuracy = control.accuracy;
    text += format(
        "\n%s%zu points, %zu of no strip. RMSE_V %.4f m (class %.0f cm) with %.4f m for the "
        "survey of the points%s\n  [%s]\n  older: NVA at 95 %% = 1.96 RMSEz = %.4f m [%s]\n  "
        "absolute accuracy %s [%s]\n",
        label, control.points, control.unseen.size(), accuracy.rmse_v, accuracy.class_cm,
        accuracy.survey, control.survey_known ? "" : " (assumed: the file gives none)",
        kPositionalStandard, accuracy.nva_95, kOlderPositionalStandard,
        levelName(control.quality_level).c_str(), kAbsoluteSpecification);
    if (!accuracy.enough_points)
      text += format("  fewer than the %zu check points that the standard asks for\n",
                     kFewestCheckPoints);
  };
  if (report.before && report.before->control) figures("Before: ", *report.before->control);
  figures(report.before ? "After: " : "", *report.block.control);
  return text;
}

}  // namespace

std::string levelName(const std::optional<int>& level) {
  return level ? format("QL%d", *level) : "none";
}

bool hasAnswer(const CheckedBlock& block) {
  return (block.control && block.control->points > 0) ||
         std::any_of(block.pairs.begin(), block.pairs.end(), judged);
}

std::string qualityText(const QualityReport& report) {
  std::string text = verticalTable(report) + alignmentTable(report) + shiftTable(report) +
                     trendTable(report) + triangleTable(report) + controlTable(report);
  const QualityLevelLimits& limits =
      qualityLevels()[static_cast<std::size_t>(report.quality_level)];
  std::size_t kept = 0, all = 0;
  for (const CheckedPair& pair : report.block.pairs) {
    if (!judged(pair)) continue;
    ++all;
    kept += pair.assessment.vertical.rms <= limits.swath_overlap_rmsdz ? 1 : 0;
  }
  text += format("\n%zu of %zu pairs keep QL%d: RMSDz at most %.2f m [%s]\n", kept, all,
                 report.quality_level, limits.swath_overlap_rmsdz, kSwathSpecification);
  for (const std::string& warning : report.block.warnings) text += "\nwarning: " + warning + '\n';
  return text;
}

}  // namespace pcl_als::app
