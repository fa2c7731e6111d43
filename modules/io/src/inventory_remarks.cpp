// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "inventory_remarks.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <pcl_als/common/coordinate_steps.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/time_scale.h>
#include <pcl_als/las/external_waveforms.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/recorded_pose.h>
#include <pcl_als/las/unclaimed_bytes.h>

#include "pcd_file.h"
#include "xyz_file.h"

namespace pcl_als::detail {
namespace {

constexpr double kLastWeekSecond = 2.0 * 604800.0;  // some count on past the end of the week
constexpr std::uint64_t kFewPoints = 1000;
constexpr float kLargeScanAngle = 60.0F;  // degrees; line scanners for mapping stay below 40

std::string percentOf(std::uint64_t part, std::uint64_t whole) {
  std::ostringstream text;
  text.precision(3);
  text << 100.0 * static_cast<double>(part) / static_cast<double>(whole) << " %";
  return text.str();
}

/// "1 point (0.5 %) <one>" or "12 points (0.5 %) <many>" when there are any.
void remarkCount(Warnings& remarks, std::uint64_t part, std::uint64_t whole, const char* one,
                 const char* many) {
  if (part > 0)
    remarks.push_back(counted(part, "point") + " (" + percentOf(part, whole) + ") " +
                      (part == 1 ? one : many));
}

/// In which unit the first time of a file is recorded, which readers bring to seconds.
double timeUnitsOf(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  PointChunk first;
  if (extension == ".xyz") {
    XyzFile file(path, {}, "");
    file.read(1, first);
    return file.timeUnits();
  }
  if (extension == ".pcd" || extension == ".ply") {
    PcdFile file(path, "");
    file.read(1, first);
    return file.timeUnits();
  }
  const LasFile las(path, kLazAllFields, LasDamage::keep_intact);
  if (las.layout().gps_time < 0 || las.header().point_count == 0) return 1.0;
  std::vector<std::byte> record(las.header().record_length);
  try {
    las.readRecords(0, 1, record.data());
  } catch (const InputError&) {
    return 1.0;  // damaged there, as is said elsewhere
  }
  return timeUnitsPerSecond(loadLas<double>(record.data() + las.layout().gps_time));
}

void remarkTimes(const PointFileInfo& info, const PointStatistics& s, Warnings& remarks) {
  if (info.time_kind == TimeKind::none) {
    remarks.push_back("the points have no GPS time: they cannot be tied to a trajectory");
    return;
  }
  remarkCount(remarks, s.invalid_times, s.points, "has a GPS time that is no number",
              "have a GPS time that is no number");
  if (s.zero_times == s.points) {
    remarks.push_back("every GPS time is zero: the points cannot be tied to a trajectory");
    return;
  }
  remarkCount(remarks, s.zero_times, s.points, "has GPS time zero", "have GPS time zero");
  const std::string unix_time = unixTimeText({s.first_time, s.last_time}, timeUnitsOf(info.path));
  if (!unix_time.empty()) {
    remarks.push_back("the times look like " + unix_time);
    return;
  }
  const std::string extension = lowerExtension(info.path);
  if (extension != ".las" && extension != ".laz") return;  // declares none
  const TimeScale declared =
      info.time_kind == TimeKind::week_seconds ? TimeScale::week : TimeScale::adjusted;
  const bool in_week = s.first_time >= 0.0 && s.last_time <= kLastWeekSecond;
  const TimeScale probable =
      in_week ? TimeScale::week
              : probableTimeScales({s.first_time, s.last_time}, info.time_kind).front();
  if (probable == declared) return;
  const std::string date =
      in_week ? "" : dateText(s.first_time + gpsSecondsOffset(probable, s.first_time));
  remarks.push_back("the times look like " + timeScaleName(probable) +
                    (date.empty() ? "" : " (" + date + ")") + ", not like " +
                    timeScaleName(declared) + ", as which they are declared");
}

void remarkHeader(const LasHeader& h, const PointStatistics& s, Warnings& remarks) {
  const std::size_t numbers = h.version_minor >= 4 && h.point_format >= 6 ? 15 : 5;
  for (std::size_t r = 1; r <= numbers; ++r) {
    if (h.points_by_return[r - 1] == s.returns[std::min<std::size_t>(r, 15)]) continue;
    remarks.push_back("the header's number of points by return is wrong (return " +
                      std::to_string(r) + ": it says " + std::to_string(h.points_by_return[r - 1]) +
                      ", there are " + std::to_string(s.returns[r]) + ")");
    break;
  }
  if (h.version_minor >= 4 && h.point_format <= 5 && h.legacy_point_count != h.point_count &&
      h.point_count <= 0xFFFFFFFFU)
    remarks.push_back(
        "the header's two point counts differ: " + std::to_string(h.legacy_point_count) + " and " +
        std::to_string(h.point_count) + "; the second is used");
}

/// The times of the points in the header of LAS 1.5, where it states them.
void remarkHeaderTimes(const LasHeader& h, const PointStatistics& s, Warnings& remarks) {
  constexpr double kRounding = 1e-6;  // seconds
  const double first = h.earliest_time + h.timeShift(), last = h.latest_time + h.timeShift();
  if (h.version_minor < 5 || (h.earliest_time == 0.0 && h.latest_time == 0.0) ||
      s.zero_times == s.points)
    return;
  if (std::abs(first - s.first_time) <= kRounding && std::abs(last - s.last_time) <= kRounding)
    return;
  std::ostringstream text;
  text.precision(13);
  text << "the header's times are wrong: it says " << first << " to " << last
       << ", the points have " << s.first_time << " to " << s.last_time;
  remarks.push_back(text.str());
}

void remarkCrs(const PointFileInfo& info, Warnings& remarks) {
  if (info.crs.empty())
    remarks.emplace_back(
        "the coordinate reference system is unknown (" +
            (info.crs_ignored.empty() ? "no WKT, no EPSG code" : info.crs_ignored) + ")",
        Hint::crs);
  if (info.crs_kind == CrsKind::geographic)
    remarks.emplace_back(
        "the coordinates are degrees: project them to a metric system first; lengths and areas "
        "here count degrees as metres");
  else if (info.crs_kind == CrsKind::geocentric)
    remarks.emplace_back("the coordinates are geocentric: project them to a metric system first");
  else if (!info.units.known() && !info.crs.empty())
    remarks.emplace_back("PROJ knows no unit of length for the CRS; metres are assumed");
  else if (!info.units.known())
    remarks.emplace_back("the unit of length is not stated; metres are assumed");
  else if (!info.units.metric() && !info.units.verticalKnown())
    remarks.emplace_back("the unit of the heights is not stated; that of the plan is assumed");
}

/// A trajectory of such points is that of their records, however coarse their times are.
void remarkPose(const LasFile& las, Warnings& remarks) {
  const std::string pose = recordedPose(las.extraFields());
  if (pose.empty()) return;
  remarks.push_back("each record holds the pose of the sensor (" + pose +
                    "), which is not used: write these fields with the time of each pulse to a "
                    "trajectory as CSV, in metres and degrees, heading clockwise from "
                    "grid north");
}

void remarkSteps(const FileInventory& file, Warnings& remarks) {
  constexpr double kCoarser = 1.5;       // times the scale
  constexpr double kNoticeable = 0.005;  // metres
  const Eigen::Vector3d limit = (kCoarser * file.info.resolution).cwiseMax(kNoticeable);
  const std::string steps = describeSteps(file.steps, limit);
  if (!steps.empty())
    remarks.push_back("the coordinates have steps of " + steps +
                      ", coarser than the scale of the file: they passed single precision or a "
                      "file with a larger scale");
}

void remarkFile(FileInventory& file, const PointWindow& window) {
  const bool whole = window.everything();
  const PointStatistics& s = file.statistics;
  auto& remarks = file.remarks;
  if (s.points == 0) {
    remarks.emplace_back(whole ? "the file holds no points" : "no point of the file was read");
    return;
  }
  const auto add = [&remarks](const std::string& text) {
    if (!text.empty()) remarks.push_back(text);
  };
  remarkTimes(file.info, s, remarks);
  const std::string extension = lowerExtension(file.info.path);
  if (extension == ".las" || extension == ".laz") {
    const LasFile las(file.info.path, kLazAllFields,
                      window.keep_readable ? LasDamage::keep_intact : LasDamage::refuse);
    if (whole) remarkHeader(las.header(), s, remarks);
    if (whole) remarkHeaderTimes(las.header(), s, remarks);
    remarkPose(las, remarks);
    remarks.insert(remarks.end(), las.remarks().begin(), las.remarks().end());
    add(ExternalWaveforms::of(las).describe());
    add(unclaimedBytes(las).describe());
  }
  remarkCount(remarks, s.invalid_coordinates, s.points, "has coordinates that are no place",
              "have coordinates that are no place");
  remarkCount(remarks, s.wrong_returns, s.points,
              "has return number zero or one above its number of returns",
              "have return number zero or one above their number of returns");
  remarkCount(remarks, s.withheld, s.points, "is flagged as withheld", "are flagged as withheld");
  if (s.largest_intensity == 0.0F && s.least_intensity == 0.0F)
    remarks.emplace_back("every intensity is zero");
  remarkSteps(file, remarks);
  remarkCrs(file.info, remarks);
}

/// Rounded times: an aircraft is metres to tens of metres further when they change.
void remarkRoundedTimes(StripInventory& strip) {
  const std::string rounded = strip.times.describe();
  if (rounded.empty()) return;
  strip.remarks.push_back("has times in " + rounded + ": too coarse for a trajectory");
}

void remarkScanAngles(const PointStatistics& s, Warnings& remarks) {
  const float largest = std::max(std::abs(s.least_scan_angle), std::abs(s.largest_scan_angle));
  if (!(largest >= kLargeScanAngle)) return;
  std::ostringstream text;
  text.precision(4);
  text << "has scan angles of " << s.least_scan_angle << " to " << s.largest_scan_angle
       << " degrees: beyond " << kLargeScanAngle
       << " degrees the scanner rotates or looks sideways, or the angles are in another unit";
  remarks.push_back(text.str());
}

/// A gap in which an aircraft may turn lies between two flight lines.
void remarkGaps(StripInventory& strip) {
  constexpr double kShortestTurn = 20.0;  // seconds
  if (strip.gaps.empty()) return;
  double longest = 0.0;
  for (const TimeGap& gap : strip.gaps) longest = std::max(longest, gap.to - gap.from);
  const std::string text = "has " + counted(strip.gaps.size(), "gap") + " in time of more than 1 s";
  if (longest < kShortestTurn)
    strip.remarks.emplace_back(text);
  else
    strip.remarks.emplace_back(text + ", the longest of " + std::to_string(std::lround(longest)) +
                                   " s: it may be several flight lines under one id",
                               Hint::split);
}

void remarkStrip(StripInventory& strip, bool has_time) {
  const PointStatistics& s = strip.statistics;
  if (s.points < kFewPoints)
    strip.remarks.push_back("holds only " + counted(s.points, "point") + ", too few to use");
  if (has_time) remarkGaps(strip);
  if (has_time) remarkRoundedTimes(strip);
  remarkScanAngles(s, strip.remarks);
}

/// Numbers that are not those of flight lines.
void remarkIds(DatasetInventory& survey) {
  const std::vector<StripInventory>& strips = survey.strips;
  const auto simultaneous = std::count_if(
      strips.begin(), strips.end(), [](const auto& s) { return s.recorded_with.has_value(); });
  if (strips.size() > DatasetInventory::kMostLines) {
    survey.remarks.emplace_back("there are " + grouped(strips.size()) +
                                    " point source ids, more than a survey has flight lines: they "
                                    "number something else, such as pulses; which of them overlap "
                                    "is not examined",
                                Hint::split);
  } else if (simultaneous > 0) {
    const auto first = std::find_if(strips.begin(), strips.end(),
                                    [](const auto& s) { return s.recorded_with.has_value(); });
    survey.remarks.emplace_back(
        counted(static_cast<std::uint64_t>(simultaneous), "strip") +
            (simultaneous == 1 ? " was" : " were") + " recorded at the times of others (" +
            first->id + " with " + strips[*first->recorded_with].id +
            "): scanners, channels or tiles of one flight line with ids of their own, whose "
            "trajectory errors are the same",
        Hint::split);
  }
}

void remarkChannels(DatasetInventory& survey) {
  const auto ofSeveral = [](const StripInventory& strip) {
    const auto& channels = strip.statistics.channels;
    return std::count(channels.begin(), channels.end(), 0U) < 3;
  };
  const auto strips = std::count_if(survey.strips.begin(), survey.strips.end(), ofSeveral);
  if (strips == 0) return;
  survey.remarks.emplace_back(counted(static_cast<std::uint64_t>(strips), "strip") +
                                  (strips == 1 ? " has" : " have") +
                                  " points of several scanner channels, which may have mounting "
                                  "angles of their own",
                              Hint::channels);
}

}  // namespace

void addRemarks(DatasetInventory& survey) {
  for (FileInventory& file : survey.files) remarkFile(file, survey.window);
  if (!survey.window.everything())
    survey.remarks.push_back("a part of the files was read: " + describe(survey.window));
  const bool has_time = std::any_of(survey.files.begin(), survey.files.end(), [](const auto& f) {
    return f.info.time_kind != TimeKind::none;
  });
  for (StripInventory& strip : survey.strips) remarkStrip(strip, has_time);
  const TimeKind kind = survey.files.empty() ? TimeKind::none : survey.files[0].info.time_kind;
  for (const FileInventory& file : survey.files)
    if (file.info.time_kind != kind) {
      survey.remarks.emplace_back("the files count GPS time in different ways");
      break;
    }
  if (survey.duplicates > 0)
    survey.remarks.push_back((survey.duplicates_estimated ? "about " : "") +
                             counted(survey.duplicates, "point") +
                             (survey.duplicates == 1 ? " repeats" : " repeat") +
                             " another point (place, time, return and source id)");
  remarkIds(survey);
  remarkChannels(survey);
  if (survey.strips.size() == 1)
    survey.remarks.emplace_back("there is one strip only: nothing to compare it with", Hint::split);
  if (survey.strips.size() > 1 && survey.strips.size() <= DatasetInventory::kMostLines &&
      survey.overlaps.empty())
    survey.remarks.emplace_back("no two strips overlap");
}

}  // namespace pcl_als::detail
