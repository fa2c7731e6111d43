// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/trajectory_accuracy.h>
#include <pcl_als/trajectory/heading_check.h>
#include <pcl_als/trajectory/trajectory_screening.h>

#include "inventory_fields.h"

namespace pcl_als {
namespace {

using namespace field;

/// None where a file states none.
std::optional<AccuracySummary> deviationsOf(const std::vector<TrajectoryAccuracy>& accuracies) {
  if (accuracies.empty()) return std::nullopt;
  return summarize(accuracies);
}

const Fields<AccuracySummary>& accuracySummaryFields() {
  using A = AccuracySummary;
  static const Fields<A> fields(
      "standard_deviations", "Root mean squares of stated standard deviations.",
      {{"position_m", &A::position, "Of one axis"},
       {"roll_pitch_arcsec", &A::roll_pitch, "Roll and pitch", in(kRadiansPerArcsec)},
       {"heading_arcsec", &A::heading, "Heading", in(kRadiansPerArcsec)}});
  return fields;
}

/// How the heading agrees with the course.
struct HeadingFacts {
  double from_course = std::nan("");
  std::optional<bool> follows;
  std::optional<std::string> reading;
  std::string axes;
  bool open = false;  ///< the axes of the attitude are not known
};

/// None without attitude or motion.
std::optional<HeadingFacts> headingOf(const TrajectoryFacts& facts) {
  HeadingFacts heading;
  heading.axes = facts.axes;
  heading.open = facts.attitude_form == AttitudeForm::quaternion;
  if (!facts.attitude) return std::nullopt;
  if (heading.open) return heading;
  const HeadingCheck check = headingCheck(facts.local);
  if (check.count() == 0) return std::nullopt;
  heading.from_course = check.deviation(HeadingReading::heading);
  heading.follows = check.followsCourse();
  if (!check.followsCourse() && check.best() != HeadingReading::heading)
    heading.reading = std::string(describe(check.best()));
  return heading;
}

const Fields<HeadingFacts>& headingFields() {
  using H = HeadingFacts;
  static const Fields<H> fields(
      "heading", "How the heading agrees with the course.",
      {{"from_course_deg", &H::from_course, "Median angle from the course"},
       {"follows_course", &H::follows, "Whether it follows the course"},
       {"would_follow_as", &H::reading, "As what it would follow the course"},
       {"axes", &H::axes, "What is known of the axes of the attitude",
        onlyIf([](const H& h) { return h.open || !h.axes.empty(); })}});
  return fields;
}

/// Samples that are excluded where the trajectory is used.
struct ListedOutliers {
  OutlierRun run;
  std::uint32_t first;
  bool lines;
  bool records() const { return !lines; }
  bool inPosition() const { return run.distance > 0.0; }
  bool turned() const { return run.turn > 0.0; }
};

const Fields<ListedOutliers>& outlierFields() {
  using O = ListedOutliers;
  static const Fields<O> fields(
      "outliers", "Samples that contradict their neighbours.",
      {{"line", &O::first, "Line of the first one", onlyIf(&O::lines)},
       {"record", &O::first, "Record of the first one", onlyIf(&O::records)},
       {"samples", [](const O& o) { return o.run.samples.size(); }, "Number of samples"},
       {"time", [](const O& o) { return Eigen::Vector2d(o.run.from, o.run.to); },
        "Of the first and the last one", of("s")},
       {"distance_m", [](const O& o) { return o.run.distance; }, "From the path of the others",
        onlyIf(&O::inPosition)},
       {"turn_deg", [](const O& o) { return o.run.turn; }, "Difference of the attitude",
        in(kRadiansPerDegree), onlyIf(&O::turned)}});
  return fields;
}

struct TrajectoryEntry {
  const std::string* path;
  const TrajectoryFacts* facts;
  std::vector<ListedOutliers> outliers;
  std::optional<std::string> objection;
};

std::vector<TrajectoryEntry> trajectoriesOf(const ListedTrajectory& flight) {
  std::vector<TrajectoryEntry> all;
  for (const auto& [path, facts] : flight.trajectories) {
    TrajectoryEntry entry{&path, &facts, {}, {}};
    const SamplePlaces& places = facts.places;
    const TrajectoryScreening screening = screenTrajectory(facts.local);
    for (const OutlierRun& run : screening.outliers)
      entry.outliers.push_back({run, places.numbers[run.samples.front()], places.lines});
    const std::string objection =
        screening.objection([&](std::size_t sample) { return places.name(sample); });
    if (!objection.empty()) entry.objection = objection;
    all.push_back(std::move(entry));
  }
  return all;
}

const Fields<TrajectoryEntry>& trajectoryFields() {
  using E = TrajectoryEntry;
  using F = TrajectoryFacts;
  static const Fields<F> facts(
      "trajectory_facts", "What the file states.",
      {{"format", &F::format, "Format of the file"},
       {"frame", &F::frame, "Coordinates and datum"},
       {"columns", &F::columns, "How columns were taken"},
       {"samples", &F::samples, "Number of samples"},
       {"time", [](const F& f) { return Eigen::Vector2d(f.times.first, f.times.last); },
        "Of the first and the last one", of("s")},
       {"time_kind", &F::time_kind, "How times count"},
       {"samples_per_second", [](const F& f) { return 1.0 / f.median_step; }, "Rate",
        knownIf([](const F& f) { return f.median_step > 0.0; })},
       {"attitude", &F::attitude, "Whether every sample has an attitude"},
       {"heading", headingOf, headingFields(), "How the heading agrees with the course"},
       {"standard_deviations", [](const F& f) { return deviationsOf(f.accuracy); },
        accuracySummaryFields(), "Stated standard deviations"}});
  static const Fields<E> fields(
      "trajectory", "A trajectory file.",
      {{"path", [](const E& e) { return *e.path; }, "The file"},
       Field<E>::all([](const E& e) -> const F& { return *e.facts; }, facts),
       {"outliers", &E::outliers, outlierFields(), "Samples that are excluded"},
       {"unusable", &E::objection, "Why it cannot be used"}});
  return fields;
}

const Fields<StripScanner>& scannerFields() {
  using S = StripScanner;
  static const Fields<S> fields(
      "scanner", "The scanner of a strip, as its points show it.",
      {{"strip", &S::strip, "Name of the strip"},
       {"type", [](const S& s) { return nameOf(s.scanner.pattern); }, "Pattern of the scan"},
       {"channels", [](const S& s) { return s.scanner.channels; }, "Number of channels"},
       {"angle_deg", [](const S& s) { return s.scanner.angle; }, "Its angle",
        in(kRadiansPerDegree)}});
  return fields;
}

}  // namespace

const Fields<ListedTrajectory>& flightFields() {
  using L = ListedTrajectory;
  const auto times = [](const L& l) {
    return Eigen::Vector2d(l.accuracy.front().time, l.accuracy.back().time);
  };
  static const Fields<L> accuracies(
      "accuracies", "A file of accuracies.",
      {{"path", &L::accuracy_path, "The file"},
       {"records", [](const L& l) { return l.accuracy.size(); }, "Number of records"},
       {"time", times, "Of the first and the last one", of("s")},
       {"standard_deviations", [](const L& l) { return deviationsOf(l.accuracy); },
        accuracySummaryFields(), "Root mean squares"}});
  static const Fields<L> fields(
      "flight", "Files of a flight.",
      {{"trajectories", trajectoriesOf, trajectoryFields(), "Trajectory files"},
       {"scanners", [](const L& l) { return l.assessment.scanners; }, scannerFields(),
        "Scanners by strip", unlessEmpty},
       {"flight_remarks", [](const L& l) { return textsOf(l.assessment.warnings); },
        "What does not agree", onlyIf([](const L& l) { return !l.trajectories.empty(); })},
       {"accuracies", kSameObject, accuracies, "File of accuracies",
        onlyIf([](const L& l) { return !l.accuracy.empty(); })}});
  return fields;
}

}  // namespace pcl_als
