// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

#include "flights.h"
#include "ray_flight.h"

namespace pcl_als {
namespace {

using Samples = std::vector<TrajectorySample>;

const Eigen::Vector3d kPlace(433'000.0, 5'812'000.0, 0.0);
constexpr double kCourses[] = {0.0, 180.0, 90.0};  // one strip each, degrees

/// Three lines at 1000 m with headings 3 degrees off the course, level otherwise.
Samples flown() {
  Samples samples;
  for (int line = 0; line < 3; ++line) {
    auto part = test::sampled(test::straight(kCourses[line], kPlace), -10.0, 10.0, 0.1);
    for (TrajectorySample& sample : part) {
      sample.time += 1000.0 * line + 100.0;
      sample.heading = (kCourses[line] - 3.0) * kRadiansPerDegree;
      sample.roll = sample.pitch = 0.0;
    }
    samples.insert(samples.end(), part.begin(), part.end());
  }
  return samples;
}

/// Points of a swath of 30 degrees under the lines of flown(), given to the check of \a samples;
/// \a step: of the times.
TrajectoryPlausibility seenFrom(const Samples& samples, bool attitude = false, double step = 0.0) {
  Trajectory::Options options;
  options.use_attitude = attitude;
  TrajectoryPlausibility check(std::make_shared<const Trajectory>(samples, options));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> lateral(-270.0, 270.0), time(-9.0, 9.0);
  for (int line = 0; line < 3; ++line) {
    const int strip = check.addStrip(std::to_string(line + 1));
    const double angle = kCourses[line] * kRadiansPerDegree;
    const Eigen::Vector3d right(std::cos(angle), -std::sin(angle), 0.0);
    for (int i = 0; i < 500; ++i) {
      const double t = time(random);
      const Eigen::Vector3d sensor = test::straight(kCourses[line], kPlace)(t);
      const Eigen::Vector3d point =
          sensor + lateral(random) * right - Eigen::Vector3d(0.0, 0.0, 1000.0);
      double tag = t + 1000.0 * line + 100.0;
      if (step > 0.0) tag = step * std::round(tag / step);
      check.add(strip, tag, point);
    }
    for (int i = 0; step > 0.0 && i < 36'000; ++i) {  // 2000 points per second
      check.addTime(strip, step * std::round((1000.0 * line + 91.0 + 5e-4 * i) / step));
    }
  }
  return check;
}

/// What the check says of a trajectory that was changed; empty: nothing.
template <typename Change>
std::string saidOfChange(const Change& change, bool attitude = false) {
  Samples samples = flown();
  for (TrajectorySample& sample : samples) change(sample);
  try {
    const auto warnings = seenFrom(samples, attitude).check(false);
    return warnings.empty() ? "" : "warning: " + warnings.front().text;
  } catch (const InputError& error) {
    return error.what();
  }
}

/// One line of ray_flight.h over trees, without scan angles, checked with a trajectory of another
/// place or time.
std::string raysSay(const Eigen::Vector3d& moved, double late, bool force = false) {
  test::RayFlight flight;
  flight.path = test::wavyPath;
  flight.angle_step = 0.0;
  Samples samples;
  for (int i = -10; i < 260; ++i) {
    TrajectorySample& sample = samples.emplace_back();
    sample.time = 0.1 * i;
    sample.position = test::wavyPath(sample.time - late) + moved;
  }
  TrajectoryPlausibility check(std::make_shared<const Trajectory>(samples));
  check.addStrip("7");
  std::size_t i = 0;
  for (const LidarReturn& point : flight.points()) {
    if (i++ % 8 == 0) check.add(0, point.time, point.position);
    check.addReturn(0, point);
  }
  try {
    const Warnings warnings = check.check(force);
    return warnings.empty() ? "" : "warning: " + warnings.front().text;
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(TrajectoryPlausibility, RaysShowATrajectoryBesideTheTrueOne) {
  EXPECT_EQ(raysSay({0.0, 0.0, 0.0}, 0.0), "");
  EXPECT_EQ(raysSay({1.0, -1.0, 2.0}, 0.0), "");  // lever arms
  for (const Eigen::Vector3d& moved :
       {Eigen::Vector3d(60.0, 0.0, 0.0), Eigen::Vector3d(0.0, 50.0, 0.0),
        Eigen::Vector3d(0.0, 0.0, 100.0), Eigen::Vector3d(30.0, -30.0, -40.0)}) {
    const std::string text = raysSay(moved, 0.0);
    EXPECT_EQ(text.rfind("strip 7: the trajectory lies", 0), 0U) << text;
    EXPECT_NE(text.find("rays"), std::string::npos) << text;
    EXPECT_EQ(raysSay(moved, 0.0, true).rfind("warning: strip 7", 0), 0U);
  }
  const std::string late = raysSay({0.0, 0.0, 0.0}, 1.0);
  EXPECT_NE(late.find("1.00 s of flight"), std::string::npos) << late;
}

TEST(TrajectoryPlausibility, AcceptsTheRightOne) {
  for (const bool attitude : {false, true}) {
    EXPECT_EQ(saidOfChange([](TrajectorySample&) {}, attitude), "");
  }
}

TEST(TrajectoryPlausibility, RefusesPositionsThatAreNotThePoints) {
  EXPECT_NE(saidOfChange([](auto& s) { s.position /= 0.3048; }), "");
  EXPECT_NE(saidOfChange([](auto& s) { std::swap(s.position.x(), s.position.y()); }), "");
  EXPECT_NE(saidOfChange([](auto& s) { std::swap(s.position.x(), s.position.z()); }), "");
  EXPECT_NE(saidOfChange([](auto& s) { s.position.x() += 400e3; }), "");
  EXPECT_NE(
      saidOfChange([](auto& s) { s.position.z() += 400e3; }).find("401000 m below the trajectory"),
      std::string::npos);
  EXPECT_NE(saidOfChange([](auto& s) { s.position.z() -= 1100.0; }).find("above the trajectory"),
            std::string::npos);
  EXPECT_NE(saidOfChange([](auto& s) {
              s.position.x() += 4e3;
            }).find("strip 1: its points lie 4000 m beside"),
            std::string::npos);
}

TEST(TrajectoryPlausibility, RefusesADisplacementThatNoStripShowsAlone) {
  const std::string text =
      saidOfChange([](auto& s) { s.position += Eigen::Vector3d(-120.0, 90.0, 0.0); });
  EXPECT_NE(text.find("lies 150 m (east -120, north 90) beside"), std::string::npos) << text;
}

// 2026-11: such attitude was used without a word, and boresights came out wrong by degrees.
TEST(TrajectoryPlausibility, RefusesAHeadingThatIsNone) {
  const auto in = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  // What a reader makes of radians: as if they were degrees.
  EXPECT_TRUE(
      in(saidOfChange([](auto& s) { s.heading *= kRadiansPerDegree; }, true), "in radians"));
  EXPECT_TRUE(in(saidOfChange([](auto& s) { s.heading = 0.5 * kPi - s.heading; }, true),
                 "counter-clockwise from east"));
  EXPECT_TRUE(in(saidOfChange([](auto& s) { s.heading += kPi; }, true), "heading + 180"));
  EXPECT_TRUE(in(saidOfChange([](auto& s) { s.heading = 0.0; }, true), "column without values"));
  EXPECT_EQ(saidOfChange([](auto& s) { s.heading = 0.0; }, false), "")
      << "the attitude is not used";
}

/// One line with motion in pitch and roll, its points by a forward chain of its own; what the check
/// says when the attitude is changed before it is given.
template <typename Change>
std::string saidOfMotion(const Change& change, double motion = 1.0) {
  Samples samples = test::sampled(test::straight(0.0), 0.0, 20.0, 0.005);
  std::vector<std::pair<double, Eigen::Vector3d>> points;
  for (TrajectorySample& sample : samples) {
    sample.roll = motion * 0.03 * std::sin(0.9 * sample.time);
    sample.pitch = 0.02 + motion * 0.02 * std::sin(0.7 * sample.time);
    sample.heading = 0.04;
    const Eigen::Matrix3d body = (Eigen::AngleAxisd(-sample.heading, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(sample.pitch, Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(sample.roll, Eigen::Vector3d::UnitY()))
                                     .toRotationMatrix();
    for (int i = -6; i <= 6; ++i) {
      const double beta = 0.35 * i / 6.0;
      const Eigen::Vector3d pulse = body * Eigen::Vector3d(-std::sin(beta), 0.0, -std::cos(beta));
      points.emplace_back(sample.time, sample.position + pulse * (1000.0 / -pulse.z()));
    }
  }
  for (TrajectorySample& sample : samples) change(sample);
  Trajectory::Options options;
  options.use_attitude = true;
  TrajectoryPlausibility check(std::make_shared<const Trajectory>(samples, options));
  check.addStrip("1");
  for (const auto& [time, point] : points) check.add(0, time, point);
  const auto findings = check.findings();
  return findings.empty()
             ? ""
             : (findings[0].refuse ? "refused: " : "warning: ") + findings[0].warning.text;
}

// 2026-11: signs and units of roll and pitch were never compared with the points.
TEST(TrajectoryPlausibility, ComparesRollAndPitchWithThePoints) {
  const auto begins = [](const std::string& text, const std::string& with) {
    return text.rfind(with, 0) == 0;
  };
  EXPECT_EQ(saidOfMotion([](auto&) {}), "");
  const std::string pitch = saidOfMotion([](auto& s) { s.pitch = -s.pitch; });
  EXPECT_TRUE(begins(pitch, "refused: the pitch of the trajectory has the opposite sign")) << pitch;
  const std::string roll = saidOfMotion([](auto& s) { s.roll = -s.roll; });
  EXPECT_TRUE(begins(roll, "refused: the roll of the trajectory has the opposite sign")) << roll;
  const std::string radians = saidOfMotion([](auto& s) {
    s.roll *= kRadiansPerDegree, s.pitch *= kRadiansPerDegree, s.heading *= kRadiansPerDegree;
  });
  EXPECT_TRUE(begins(radians, "refused: the pitch of the trajectory changes by")) << radians;
  // A level model is wrong by a percent of the biases where the motion is a degree.
  const auto level = [](auto& s) { s.roll = s.pitch = s.heading = 0.0; };
  const std::string large = saidOfMotion(level);
  EXPECT_TRUE(begins(large, "refused: the pitch of the trajectory is the same")) << large;
  const std::string small = saidOfMotion(level, 0.3);
  EXPECT_TRUE(begins(small, "warning: the pitch of the trajectory is the same")) << small;
}

TEST(TrajectoryPlausibility, ForceGoesOnWithAWarning) {
  Samples samples = flown();
  for (TrajectorySample& sample : samples) sample.position.x() += 4e3;
  const TrajectoryPlausibility check = seenFrom(samples);
  EXPECT_THROW(check.check(false), InputError);
  EXPECT_FALSE(check.check(true).empty());
}

// 2026-11: points with times in whole seconds were reported as a trajectory beside its place.
TEST(TrajectoryPlausibility, NamesTimesInWholeSeconds) {
  const auto findings = seenFrom(flown(), false, 1.0).findings();
  ASSERT_FALSE(findings.empty());
  EXPECT_TRUE(findings[0].refuse);
  EXPECT_NE(
      findings[0].warning.text.find("whole seconds (19 distinct values in 36000 points), in a "
                                    "step of which the sensor moves 60 m"),
      std::string::npos)
      << findings[0].warning.text;
  // 0.05 s: 1.5 m of 1000 m, worth a warning; 0.001 s: nothing.
  const auto fine = seenFrom(flown(), false, 0.05).findings();
  ASSERT_FALSE(fine.empty());
  EXPECT_FALSE(fine[0].refuse);
  EXPECT_TRUE(seenFrom(flown(), false, 0.001).findings().empty());
}

TEST(TrajectoryPlausibility, IgnoresStripsThatAreExcluded) {
  Samples samples = flown();
  for (TrajectorySample& sample : samples) {
    if (sample.time < 500.0) sample.position.x() += 4e3;
  }
  TrajectoryPlausibility check = seenFrom(samples);
  EXPECT_THROW(check.check(false), InputError);
  check.exclude(0);
  EXPECT_TRUE(check.check(false).empty());
}

/// The first finding about samples that were changed.
template <typename Change>
std::string findingAfter(const Change& change) {
  Samples samples = flown();
  for (TrajectorySample& sample : samples) change(sample);
  const auto findings = seenFrom(samples).findings();
  return findings.empty() ? std::string() : findings.front().warning.text;
}

TEST(TrajectoryPlausibility, NamesTheLikelyCause) {
  using Sample = TrajectorySample;
  const struct {
    void (*change)(Sample&);
    const char* expected;
  } cases[] = {
      {[](Sample& s) { std::swap(s.position.x(), s.position.y()); }, "x and y exchanged"},
      {[](Sample& s) { std::swap(s.position.x(), s.position.z()); }, "x and z exchanged"},
      {[](Sample& s) { s.position /= 0.3048; }, "with its coordinates in feet"},
      {[](Sample& s) { s.position *= 0.3048; }, "with theirs in feet"},
      // Zone 32 instead of 33 at 52.5 degrees: 668 km times the cosine.
      {[](Sample& s) { s.position.x() += 406e3; }, "a zone 6 degrees away"},
      {[](Sample& s) { s.position.x() += 4e6; }, "another number of the zone"},
      {[](Sample& s) { s.time += 18.0; }, "as if the times of the points were UTC"},
      {[](Sample& s) { s.time -= 18.0; }, "as if the times of the trajectory were UTC"},
      {[](Sample& s) { s.position.x() += 150.0; }, "as between two geodetic datums"},
  };
  for (const auto& row : cases) {
    const std::string text = findingAfter(row.change);
    EXPECT_NE(text.find(row.expected), std::string::npos) << row.expected << " / " << text;
  }
  // An offset that no cause explains gets none.
  const std::string text = findingAfter([](Sample& s) { s.position.y() += 20e3; });
  EXPECT_NE(text.find("of or behind where they were fired: give"), std::string::npos) << text;
}

}  // namespace
}  // namespace pcl_als
