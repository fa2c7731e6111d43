// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iomanip>
#include <sstream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/report/quality_report.h>

#include "quality_fields.h"

namespace pcl_als {
namespace {

/// Empty for an unknown number.
std::string decimalText(double value, int digits) {
  if (!std::isfinite(value)) return {};
  std::ostringstream out;
  out << std::fixed << std::setprecision(digits) << value;
  return out.str();
}

/// Calls row(set name, pair) for all pairs of both sets.
template <typename Row>
void forEachPair(const QualityReport& report, Row row) {
  if (report.before) {
    for (const CheckedPair& pair : report.before->pairs) row("before", pair);
  }
  for (const CheckedPair& pair : report.block.pairs) row(report.before ? "after" : "given", pair);
}

/// The table of all items of all pairs, with the columns of their fields.
template <typename Item, typename Items>
std::string csvOf(const QualityReport& report, const Fields<Item>& fields, Items items) {
  std::string text = "set,a,b," + fields.csvHeader();
  forEachPair(report, [&](const char* set, const CheckedPair& pair) {
    const std::string begin =
        std::string(set) + ',' + csvCell(pair.a) + ',' + csvCell(pair.b) + ',';
    for (const Item& item : items(pair)) text += begin + fields.csvLine(item);
  });
  return text;
}

void summaryCells(const OffsetSummary& s, std::ostream& out) {
  if (s.count == 0)
    out << ",0,,,,,,,";
  else
    out << ',' << summaryFields().csvLine(s, "");
}

void alignmentCells(const std::optional<PatchAlignmentResult>& found, std::ostream& out) {
  out << ',' << (found ? toString(found->status) : "not_tried");
  if (!found || !found->hasConverged()) {
    out << ",,,,,,,,,,,,,,,,";
    return;
  }
  for (int i = 0; i < PatchAlignmentResult::kParameters; ++i) {
    const bool angle = i >= 3;
    const double unit = angle ? kRadiansPerDegree : 1.0;
    const double value = angle ? found->motion.rotation[i - 3] : found->motion.shift[i];
    const bool known = found->parameters[static_cast<std::size_t>(i)].determined;
    out << ',' << (known ? decimalText(value / unit, 6) : "") << ','
        << (known ? decimalText(found->standardDeviation(i) / unit, 6) : "");
  }
  for (int i = 0; i < 3; ++i) out << ',' << decimalText(found->motion.centroid[i], 3);
  out << ',' << decimalText(found->sigma0, 5);
}

std::string pairsCsv(const QualityReport& report) {
  std::ostringstream out;
  out << "set,a,b,status,overlap_m2," << summaryFields().csvHeader("vertical_", "")
      << ",cells_rms_m,level," << summaryFields().csvHeader("normal_", "")
      << ",shift_east_m,shift_north_m,shift_up_m,shift_east_std_m,shift_north_std_m,shift_up_std_m,"
         "flown,across_mm_per_100m,across_std,along_mm_per_100m,along_std,time_mm_per_s,time_std,"
         "scan_angle_mm_per_deg,scan_angle_std,roll_arcsec,roll_std,roll_b_arcsec,roll_b_std,"
         "icpatch,XT_m,XT_std,YT_m,YT_std,ZT_m,ZT_std,omega_deg,omega_std,phi_deg,phi_std,"
         "kappa_deg,kappa_std,centroid_x,centroid_y,centroid_z,sigma0_m,"
         "memory_mb\n";
  forEachPair(report, [&](const char* set, const CheckedPair& pair) {
    const PairAssessment& p = pair.assessment;
    out << set << ',' << csvCell(pair.a) << ',' << csvCell(pair.b) << ',' << toString(p.status)
        << ',' << decimalText(pair.overlap_area, 0);
    summaryCells(p.vertical, out);
    out << ',' << (p.vertical_cells.count == 0 ? "" : decimalText(p.vertical_cells.rms, 5)) << ','
        << levelName(p.quality_level);
    summaryCells(p.normal, out);
    for (const Eigen::Vector3d& v : {p.horizontal.shift, p.horizontal.std})
      for (int i = 0; i < 3; ++i)
        out << ',' << (p.horizontal.determined ? decimalText(v[i], 5) : "");
    out << ',' << toString(p.trends.relation);
    const auto trend = [&](const Trend& t, double factor) {
      out << ',' << (t.determined ? decimalText(factor * t.slope, 4) : "") << ','
          << (t.determined ? decimalText(factor * t.std, 4) : "");
    };
    trend(p.trends.across, 1e5);
    trend(p.trends.along, 1e5);
    trend(p.trends.time, 1e3);
    trend(p.trends.scan_angle, 1e3);
    for (const OverlapTrends::Roll& roll : {p.trends.roll, p.trends.roll_b})
      out << ',' << (roll.determined ? decimalText(roll.value / kRadiansPerArcsec, 2) : "") << ','
          << (roll.determined ? decimalText(roll.std / kRadiansPerArcsec, 2) : "");
    alignmentCells(pair.alignment, out);
    out << ',' << decimalText(pair.memory_mb, 1) << '\n';
  });
  return out.str();
}

std::string profilesCsv(const QualityReport& report) {
  const auto bins = [](const CheckedPair& pair) {
    const OverlapTrends& t = pair.assessment.trends;
    std::vector<NamedBin> all;
    for (const auto& [over, some] :
         {std::pair("distance_m", &t.by_distance), std::pair("time_s", &t.by_time),
          std::pair("scan_angle_deg", &t.by_scan_angle)})
      for (const ProfileBin& bin : *some) all.push_back({over, bin});
    return all;
  };
  return csvOf(report, namedBinFields(), bins);
}

std::string offsetsCsv(const QualityReport& report) {
  std::ostringstream out;
  out << "set,a,b,x,y,z,distance_m,time_a,time_b,scan_angle_a_deg,scan_angle_b_deg,slope_deg,"
         "vertical_m,normal_m\n";
  forEachPair(report, [&](const char* set, const CheckedPair& pair) {
    for (const OffsetSample& s : pair.samples) {
      out << set << ',' << csvCell(pair.a) << ',' << csvCell(pair.b);
      for (int i = 0; i < 3; ++i) out << ',' << decimalText(s.position[i], 3);
      out << ',' << decimalText(pair.assessment.trends.distance(s.position), 2) << ','
          << decimalText(s.time_a, 4) << ',' << decimalText(s.time_b, 4) << ','
          << decimalText(s.scan_angle_a, 2) << ',' << decimalText(s.scan_angle_b, 2) << ','
          << decimalText(s.slope / kRadiansPerDegree, 2) << ','
          << (s.level ? decimalText(s.vertical, 4) : "") << ','
          << (s.conjugate ? decimalText(s.normal_distance, 4) : "") << '\n';
    }
  });
  return out.str();
}

std::string controlCsv(const QualityReport& report) {
  std::ostringstream out;
  out << "set,point,strip,x,y,z,above_m,slope_deg,roughness_m,left_out_because\n";
  const auto add = [&](const char* set, const CheckedBlock& block) {
    if (!block.control) return;
    for (const ControlDifference& d : block.control->differences) {
      out << set << ',' << csvCell(d.point) << ',' << csvCell(d.strip);
      for (int i = 0; i < 3; ++i) out << ',' << decimalText(d.position[i], 4);
      out << ',' << decimalText(d.above, 4) << ',' << decimalText(d.slope / kRadiansPerDegree, 2)
          << ',' << decimalText(d.roughness, 4) << ',' << csvCell(d.unfit) << '\n';
    }
    for (const std::string& point : block.control->unseen)
      out << set << ',' << csvCell(point) << ",,,,,,,,no strip covers it\n";
  };
  if (report.before) add("before", *report.before);
  add(report.before ? "after" : "given", report.block);
  return out.str();
}

/// Values that differ between identical runs, separate from the results.
std::string runCsv(const QualityReport& report) {
  std::ostringstream out;
  out << "set,a,b,milliseconds,peak_memory_mb\n";
  forEachPair(report, [&](const char* set, const CheckedPair& pair) {
    out << set << ',' << csvCell(pair.a) << ',' << csvCell(pair.b) << ','
        << decimalText(pair.milliseconds, 1) << ",\n";
  });
  out << "all,,,," << decimalText(report.peak_memory_mb, 1) << '\n';
  return out.str();
}

}  // namespace

std::map<std::string, std::string> qualityCsvTables(const QualityReport& report) {
  const auto classes = [](const CheckedPair& pair) { return pair.assessment.classes; };
  std::map<std::string, std::string> tables{{"pairs", pairsCsv(report)},
                                            {"slope_aspect", csvOf(report, classFields(), classes)},
                                            {"profiles", profilesCsv(report)},
                                            {"offsets", offsetsCsv(report)},
                                            {"run", runCsv(report)}};
  if (report.block.control) tables["control"] = controlCsv(report);
  return tables;
}

void writeQualityTables(const std::filesystem::path& folder, const QualityReport& report) {
  writeFile(folder / "quality.md", "# Quality\n" + qualityText(report));
  for (const auto& [name, text] : qualityCsvTables(report))
    writeFile(folder / (name + ".csv"), text);
}

}  // namespace pcl_als
