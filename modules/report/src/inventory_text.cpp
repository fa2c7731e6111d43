// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>

#include <pcl_als/common/class_name.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/time_scale.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/report/inventory_report.h>

#include "formatted.h"

namespace pcl_als {
namespace {

constexpr std::size_t kLongestCrs = 60;
constexpr std::size_t kMostListed = 20;  // gaps of a strip
constexpr std::size_t kMostLines = 100;  // of a list

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string entry(const char* name, const std::string& value) {
  return formatted("  %-12s", name) + printable(value) + '\n';
}

std::string remarksText(const Warnings& remarks, const std::string& indent) {
  std::string text;
  for (const Warning& remark : remarks)
    text.append(indent).append("! " + printable(remark.text) + '\n');
  return text;
}

/// The lines of a list: of a long one the first, because a file may hold tens of thousands of ids.
std::string listText(const std::vector<std::string>& lines, const char* what) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostLines, lines.size()); ++i) text += lines[i];
  if (lines.size() > kMostLines)
    text += "  … " + grouped(lines.size() - kMostLines) + " more lines on " + what +
            ", which the JSON file has\n";
  return text;
}

std::string extentText(const PointStatistics& s) {
  const Eigen::Vector3d size = s.maximum - s.minimum;
  return formatted("x %.3f … %.3f, y %.3f … %.3f, z %.3f … %.3f (%.1f m x %.1f m x %.1f m)",
                   s.minimum.x(), s.maximum.x(), s.minimum.y(), s.maximum.y(), s.minimum.z(),
                   s.maximum.z(), size.x(), size.y(), size.z());
}

/// The kind of the times by their values, which a header may contradict.
std::string timeText(const PointFileInfo& info, const PointStatistics& s) {
  if (info.time_kind == TimeKind::none) return timeKindName(info.time_kind);
  const std::string kind =
      s.zero_times == s.points
          ? timeKindName(info.time_kind)
          : timeScaleName(probableTimeScales({s.first_time, s.last_time}, info.time_kind).front());
  // 1e9 s of adjusted standard time, and what is stored less than that.
  const std::string stored =
      info.time_shift == 0.0
          ? ""
          : formatted(" (stored with an offset of %.0f million s)", 1e3 + 1e-6 * info.time_shift);
  return kind + stored +
         formatted(", %.3f … %.3f (%.1f s)", s.first_time, s.last_time, s.last_time - s.first_time);
}

std::string returnsText(const PointStatistics& s) {
  std::string text;
  for (std::size_t r = 0; r < s.returns.size(); ++r)
    if (s.returns[r] > 0)
      text += formatted("%s%zu: %s (%.1f %%)", text.empty() ? "" : ", ", r,
                        grouped(s.returns[r]).c_str(), percent(s.returns[r], s.points));
  return text + formatted("; %.1f %% single", percent(s.single_returns, s.points));
}

/// Points by scanner channel, where there are several.
std::string channelsText(const PointStatistics& s) {
  std::string text;
  std::size_t present = 0;
  for (std::size_t channel = 0; channel < s.channels.size(); ++channel) {
    if (s.channels[channel] == 0) continue;
    ++present;
    text += formatted("%s%zu: %s", text.empty() ? "" : ", ", channel,
                      grouped(s.channels[channel]).c_str());
  }
  return present > 1 ? entry("channels", text) : "";
}

/// The steps of the coordinates as the points show them.
std::string stepsText(const Eigen::Vector3d& steps) {
  if (steps.isZero()) return {};
  const auto axis = [](double step) { return step > 0.0 ? formatted("%.3g m", step) : "none"; };
  return "; the points have steps of " + axis(steps.x()) + " x " + axis(steps.y()) + " x " +
         axis(steps.z());
}

std::string classesText(const PointStatistics& s) {
  std::string text;
  for (std::size_t code = 0; code < s.classes.size(); ++code) {
    if (s.classes[code] == 0) continue;
    text += formatted("%s%s: %s (%.1f %%)", text.empty() ? "" : ", ",
                      className(static_cast<int>(code)).c_str(), grouped(s.classes[code]).c_str(),
                      percent(s.classes[code], s.points));
  }
  return text;
}

/// Contents of LAS files only: software, extra bytes, variable length records.
std::string lasText(const std::filesystem::path& path) {
  // The header and VLRs; the inventory has found what of the rest cannot be read.
  const LasFile file(path, kLazAllFields, LasDamage::keep_intact);
  const LasHeader& h = file.header();
  std::string text =
      entry("software", '"' + h.generating_software + "\", system \"" + h.system_id +
                            formatted("\", day %d of %d", h.creation_day, h.creation_year));
  for (const LasExtraField& field : file.extraFields())
    text += entry("extra field", field.name + " (" + lasExtraTypeName(field) + ")" +
                                     (field.description.empty() ? "" : ": " + field.description));
  const std::size_t described = file.extraBytes().end;
  if (described < h.record_length)
    text += entry("extra bytes",
                  std::to_string(h.record_length - described) + " per record without description");
  for (const LasVlrEntry& vlr : file.vlrs())
    text +=
        entry(vlr.extended ? "EVLR" : "VLR",
              vlr.user_id + formatted(" %d, %s bytes", vlr.record_id, grouped(vlr.length).c_str()) +
                  (vlr.description.empty() ? "" : " (" + vlr.description + ")"));
  return text;
}

std::string fileText(const FileInventory& file) {
  const PointFileInfo& info = file.info;
  const PointStatistics& s = file.statistics;
  std::string crs = info.crs.empty() ? "unknown" : info.crs.substr(0, kLongestCrs);
  if (info.crs.size() > kLongestCrs) crs += " …";
  std::string text = info.path.string() + '\n';
  text += entry("format", info.format);
  if (info.format.rfind("LA", 0) == 0) text += lasText(info.path);
  text += entry("points", grouped(s.points));
  text += entry("CRS", crs + (info.crs_ignored.empty() ? "" : "; " + info.crs_ignored));
  if (!info.crs.empty() && !describeCrs(info.crs).name.empty())
    text += entry("CRS name", describeCrs(info.crs).name);
  text += entry(
      "unit", describeUnits(info) + (info.units.metric() ? "" : "; everything below is in metres"));
  for (const AppliedCorrection& correction : parseCorrections(info.corrections))
    text += entry("corrected", correction.describe());
  text += entry("resolution", formatted("%g m x %g m x %g m", info.resolution.x(),
                                        info.resolution.y(), info.resolution.z()) +
                                  stepsText(file.steps));
  if (s.points > 0) {
    text += entry("extent", extentText(s));
    text += entry("time", timeText(info, s));
    text += entry("returns", returnsText(s));
    text += channelsText(s);
    text += entry("classes", classesText(s));
    text += entry("intensity", formatted("%g … %g", s.least_intensity, s.largest_intensity));
  }
  return text + remarksText(file.remarks, "  ");
}

std::string stripLine(const StripInventory& strip) {
  const PointStatistics& s = strip.statistics;
  const double pulses = strip.density * percent(s.first_returns, s.points) / 100.0;
  return formatted("  %-16s %12s %16.3f %16.3f %5zu %9.2f %9.2f %9.0f %6.1f … %5.1f\n",
                   strip.id.c_str(), grouped(s.points).c_str(), s.first_time, s.last_time,
                   strip.gaps.size(), strip.density, pulses, strip.area, s.least_scan_angle,
                   s.largest_scan_angle);
}

void addNotes(const StripInventory& strip, std::vector<std::string>& lines) {
  for (std::size_t g = 0; g < std::min(kMostListed, strip.gaps.size()); ++g)
    lines.push_back(formatted("  strip %s: no points from %.3f to %.3f s (%.1f s)\n",
                              strip.id.c_str(), strip.gaps[g].from, strip.gaps[g].to,
                              strip.gaps[g].to - strip.gaps[g].from));
  for (const Warning& remark : strip.remarks)
    lines.push_back("  ! strip " + strip.id + " " + remark.text + '\n');
  const std::uint64_t unsorted = strip.statistics.unsorted_times;
  if (unsorted > 0)
    lines.push_back(
        formatted("  strip %s: %s earlier than the one before in %s file\n", strip.id.c_str(),
                  unsorted == 1 ? "1 point is" : (grouped(unsorted) + " points are").c_str(),
                  unsorted == 1 ? "its" : "their"));
}

std::string stripsText(const DatasetInventory& survey) {
  std::string text =
      counted(survey.strips.size(), "strip") + formatted(" (cells of %g m)\n", survey.cell);
  text += formatted("  %-16s %12s %16s %16s %5s %9s %9s %9s %14s\n", "id", "points", "from s",
                    "to s", "gaps", "points/m2", "pulses/m2", "area m2", "scan angle deg");
  std::vector<std::string> lines, notes;
  for (const StripInventory& strip : survey.strips) {
    lines.push_back(stripLine(strip));
    addNotes(strip, notes);
  }
  return text + listText(lines, "strips") + listText(notes, "strips");
}

std::string overlapsText(const DatasetInventory& survey) {
  std::vector<std::string> lines;
  for (const StripOverlap& overlap : survey.overlaps)
    lines.push_back(formatted(
        "  %s - %s: %.0f m2 (%.0f %% of the smaller)\n", survey.strips[overlap.a].id.c_str(),
        survey.strips[overlap.b].id.c_str(), overlap.area,
        100.0 * overlap.area /
            std::min(survey.strips[overlap.a].area, survey.strips[overlap.b].area)));
  std::string text = listText(lines, "overlaps");
  if (!text.empty()) text = "Overlaps\n" + text;
  const std::vector<double>& areas = survey.area_by_strips;
  for (std::size_t n = 0; n < std::min(kMostLines, areas.size()); ++n)
    text += formatted("%s%zu: %.0f m2", n == 0 ? "  covered by number of strips: " : ", ", n + 1,
                      areas[n]);
  return text + (areas.empty() ? "" : areas.size() > kMostLines ? ", …\n" : "\n");
}

}  // namespace

std::string timeKindName(TimeKind kind) {
  if (kind == TimeKind::none) return "none";
  return kind == TimeKind::week_seconds ? "seconds of the GPS week" : "adjusted standard GPS time";
}

std::string inventoryText(const DatasetInventory& survey,
                          const std::vector<ExcludedPoints>& excluded) {
  std::string text;
  for (const FileInventory& file : survey.files) text += fileText(file) + '\n';
  text += stripsText(survey);
  for (const std::string& part : describe(excluded)) text += "  " + part + '\n';
  return text + overlapsText(survey) + remarksText(survey.remarks, "");
}

}  // namespace pcl_als
