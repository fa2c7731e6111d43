// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/lidar_system.h>
#include <pcl_als/simulation/simulator.h>
#include <pcl_als/trajectory/mounting_correction.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kArcsec = kRadiansPerArcsec;

SystemVector biasesOf(double x, double y, double z, double pitch, double roll, double heading) {
  SystemVector all;
  all << x, y, z, pitch * kArcsec, roll * kArcsec, heading * kArcsec, 0.0, 0.0;
  return all;
}

/// The vendor's program, written without the library: turns a vector by one angle after the other.
Vector3d turned(const MountingAngle& angle, double radians, const Vector3d& v) {
  const double c = std::cos(angle.sign * radians), s = std::sin(angle.sign * radians);
  if (angle.axis == 'x') return {v.x(), c * v.y() - s * v.z(), s * v.y() + c * v.z()};
  if (angle.axis == 'y') return {c * v.x() + s * v.z(), v.y(), c * v.z() - s * v.x()};
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

struct Program {
  MountingConvention convention;
  double unit = kPi / 180.0;  // radians of an angle

  /// Components along the program's body axes to right, forward, up.
  Vector3d enu(const Vector3d& v) const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      switch (convention.axes[static_cast<std::size_t>(i)]) {
        case 'r':
          sum.x() += v[i];
          break;
        case 'l':
          sum.x() -= v[i];
          break;
        case 'f':
          sum.y() += v[i];
          break;
        case 'b':
          sum.y() -= v[i];
          break;
        case 'u':
          sum.z() += v[i];
          break;
        default:
          sum.z() -= v[i];
      }
    }
    return sum;
  }

  /// A v, or A' v.
  Vector3d rotated(const Vector3d& angles, Vector3d v, bool inverse) const {
    const auto& order = convention.product;
    for (int step = 0; step < 3; ++step) {
      const int at = inverse ? order[static_cast<std::size_t>(step)]
                             : order[static_cast<std::size_t>(2 - step)];
      v = turned(convention.angles[static_cast<std::size_t>(at)],
                 (inverse ? -1.0 : 1.0) * unit * angles[at], v);
    }
    return v;
  }

  /// Point of the scanner in the body, right, forward, up.
  Vector3d inBody(const Mounting& mounting, const Vector3d& scanner) const {
    const auto toBody = [&](const Vector3d& v) {
      return rotated(mounting.angles, v, !convention.scanner_to_body);
    };
    Vector3d lever = convention.lever_in_body ? mounting.lever_arm : toBody(mounting.lever_arm);
    if (!convention.lever_to_scanner) lever = -lever;
    return enu(toBody(scanner) + lever);
  }
};

class Draws {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double normal() { return normal_(random_); }
  Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  SensorPose pose() {
    SensorPose pose;
    pose.position = Vector3d(500.0, -300.0, 1200.0) + vector(100.0);
    pose.rotation =
        simulation::groundFromBody(uniform(-0.3, 0.3), uniform(-0.2, 0.2), uniform(-kPi, kPi));
    pose.has_attitude = true;
    return pose;
  }
  Vector3d direction() { return Vector3d(normal(), normal(), normal()).normalized(); }

 private:
  std::mt19937_64 random_{42};
  std::normal_distribution<double> normal_;
};

std::vector<Program> programs() {
  std::vector<Program> all;
  for (const MountingConvention& convention : mountingConventions()) {
    const double unit = convention.name == "ros"       ? 1.0
                        : convention.name == "pcl_als" ? kPi / 648000.0
                                                       : kPi / 180.0;
    all.push_back({convention, unit});
  }
  Program inverse{mountingOrder("XZY")};  // body to scanner, lever arm of the scanner
  inverse.convention.scanner_to_body = inverse.convention.lever_to_scanner = false;
  inverse.convention.lever_in_body = false;
  all.push_back(inverse);
  Program left_handed{mountingOrder("ZYX", true), kPi / 200.0};
  left_handed.convention.axes = "fru", left_handed.convention.unit = "gon";
  left_handed.convention.angles[2].sign = -1;
  all.push_back(left_handed);
  Program euler{mountingOrder("ZXZ")};
  euler.convention.axes = "dbl", euler.convention.lever_to_scanner = false;
  all.push_back(euler);
  return all;
}

// 1,000 random mountings, also upside down and sideways, and corrections of up to a degree, in ten
// conventions: points that the program computes with the new mounting are those that the library's
// corrector makes of its old points.
TEST(MountingCorrection, PointsAgreeWithTheCorrectorInAllConventions) {
  Draws draws;
  double largest = 0.0, largest_subtracted = 0.0;
  for (const Program& program : programs()) {
    for (int n = 0; n < 1000; ++n) {
      const Mounting old{draws.vector(kPi / program.unit), draws.vector(2.0)};
      const SystemVector bias = biasesOf(draws.uniform(-0.5, 0.5), draws.uniform(-0.5, 0.5),
                                         draws.uniform(-0.5, 0.5), draws.uniform(-3600, 3600),
                                         draws.uniform(-3600, 3600), draws.uniform(-3600, 3600));
      const MountingCorrection correction = correctedMounting(program.convention, old, bias);
      const SensorPose pose = draws.pose();
      const Vector3d scanner = draws.uniform(50.0, 2000.0) * draws.direction();
      const auto point = [&](const Mounting& mounting) -> Vector3d {
        return pose.position + pose.rotation * program.inBody(mounting, scanner);
      };
      const Vector3d wanted = corrected(pose, point(old), bias);
      largest = std::max(largest, (point(correction.after) - wanted).norm());
      largest_subtracted =
          std::max(largest_subtracted, (point(correction.subtracted) - wanted).norm());
    }
  }
  EXPECT_LT(largest, 1e-9);
  EXPECT_GT(largest_subtracted, 10.0);  // metres: subtracting is no approximation here
}

// The simulator's chain of rotations: its mirror is mounted turned by large angles, and the
// mounting is assumed wrong by the biases.
TEST(MountingCorrection, PointsAgreeWithTheSimulatorsChain) {
  Draws draws;
  const MountingConvention& convention = mountingConventionNamed("zyx_frd");
  const Matrix3d axes = bodyFromAxes("frd");
  for (int n = 0; n < 1000; ++n) {
    // The simulator has B of the parameters and C of the mirror: M = B C.
    const Mounting assumed{draws.vector(180.0), draws.vector(1.0)};
    const MountingFrame frame = mountingFrame(convention, assumed);
    SystemVector bias = biasesOf(0.0, 0.0, 0.0, draws.uniform(-400, 400), draws.uniform(-400, 400),
                                 draws.uniform(-400, 400));
    const Matrix3d turn = boresightRotation(bias);
    SystemVector true_lever = SystemVector::Zero(), assumed_lever = true_lever;
    true_lever.head<3>() = draws.vector(1.0);
    assumed_lever.head<3>() = frame.lever_arm;
    bias.head<3>() = frame.lever_arm - turn * true_lever.head<3>();  // P - dP = B P_true
    const simulation::LidarSystem delivered(assumed_lever, frame.body_from_scanner);
    const simulation::LidarSystem truth(true_lever, turn.transpose() * frame.body_from_scanner);
    const simulation::Pose pose{
        {100, 200, 1000}, draws.uniform(-0.3, 0.3), draws.uniform(-0.3, 0.3), draws.uniform(-3, 3)};
    const simulation::BeamAngles beam(draws.uniform(-0.6, 0.6), draws.uniform(-0.2, 0.2));
    const double range = draws.uniform(100, 2000);

    const MountingCorrection correction = correctedMounting(convention, assumed, bias);
    SystemVector new_lever = SystemVector::Zero();
    new_lever.head<3>() = axes * correction.after.lever_arm;
    const simulation::LidarSystem renewed(new_lever, axes * correction.matrix);
    EXPECT_LT(
        (renewed.groundPoint(pose, beam, range) - truth.groundPoint(pose, beam, range)).norm(),
        1e-9);
    SensorPose sensor;
    sensor.position = pose.position, sensor.has_attitude = true;
    sensor.rotation = simulation::groundFromBody(pose.roll, pose.pitch, pose.heading);
    EXPECT_LT((corrected(sensor, delivered.groundPoint(pose, beam, range), bias) -
               truth.groundPoint(pose, beam, range))
                  .norm(),
              1e-9);
  }
}

// The signs of small corrections of a straight mounting. Assumed too large: roll by 100" (right
// side down), pitch by 40" (nose up), heading by 50" counter-clockwise. Yaw is clockwise, down is
// -up.
TEST(MountingCorrection, SignsOfAStraightMounting) {
  const MountingCorrection correction = correctedMounting(mountingConventionNamed("zyx_frd"), {},
                                                          biasesOf(0.1, 0.2, 0.3, 40, 100, 50));
  const Vector3d arcsec = 3600.0 * correction.after.angles;
  EXPECT_NEAR(arcsec[0], -100.0, 0.05);
  EXPECT_NEAR(arcsec[1], -40.0, 0.05);
  EXPECT_NEAR(arcsec[2], 50.0, 0.05);
  EXPECT_LT((correction.after.lever_arm - Vector3d(-0.2, -0.1, 0.3)).norm(), 3e-4);
  EXPECT_LT((correction.subtracted.lever_arm - Vector3d(-0.2, -0.1, 0.3)).norm(), 1e-15);
  // Products of the angles only: 100" x 50" = 0.024".
  EXPECT_LT(correction.subtracted_angle, 0.05 * kArcsec);
  // Y of NovAtel is about forward, roll, and Z counter-clockwise.
  const MountingCorrection novatel = correctedMounting(mountingConventionNamed("novatel"), {},
                                                       biasesOf(0.1, 0.2, 0.3, 40, 100, 50));
  EXPECT_LT((3600.0 * novatel.after.angles - Vector3d(-40, -100, -50)).norm(), 0.1);
  EXPECT_LT((novatel.after.lever_arm - Vector3d(-0.1, -0.2, -0.3)).norm(), 3e-4);
}

// A scanner turned by a yaw of 90 degrees: its y axis points back. A roll that is assumed too large
// by 100" is a rotation of -100" about forward, +100" about this axis: it changes the pitch.
TEST(MountingCorrection, ScannerTurnedBy90Degrees) {
  const MountingCorrection correction =
      correctedMounting(mountingConventionNamed("zyx_frd"), {{0, 0, 90}, Vector3d::Zero()},
                        biasesOf(0, 0, 0, 0, 100, 0));
  EXPECT_NEAR(correction.after.angles[0], 0.0, 1e-12);
  EXPECT_NEAR(3600.0 * correction.after.angles[1], 100.0, 1e-6);
  EXPECT_NEAR(correction.after.angles[2], 90.0, 1e-12);
  // Subtracting 100" from the roll turns it about the other axis: wrong by sqrt(2) 100".
  EXPECT_NEAR(3600.0 * correction.subtracted.angles[0], -100.0, 1e-6);
  EXPECT_NEAR(correction.subtracted_angle / kArcsec, 100.0 * std::sqrt(2.0), 0.1);
  // Upside down (roll 180 degrees), a turn about forward still is one of the roll.
  const MountingCorrection over =
      correctedMounting(mountingConventionNamed("zyx_frd"), {{180, 0, 0}, Vector3d::Zero()},
                        biasesOf(0, 0, 0, 0, 100, 0));
  EXPECT_NEAR(3600.0 * (over.after.angles[0] - 180.0), -100.0, 1e-6);
  EXPECT_NEAR(over.subtracted_angle, 0.0, 1e-9);
}

// The lever arm is turned with the scanner: 2 m to the right, heading assumed 1000" too far
// counter-clockwise (4.848 mrad): the scanner is 9.696 mm further back.
TEST(MountingCorrection, LeverArmIsTurned) {
  const MountingCorrection correction =
      correctedMounting(mountingConventionNamed("novatel"), {Vector3d::Zero(), {2, 0, 0}},
                        biasesOf(0, 0, 0, 0, 0, 1000));
  EXPECT_NEAR(correction.after.lever_arm.y(), -2.0 * std::sin(1000 * kArcsec), 1e-12);
  EXPECT_NEAR(correction.kept_lever, 9.696e-3, 1e-6);
  EXPECT_NEAR(correction.subtracted_lever, 9.696e-3, 1e-6);
}

TEST(MountingCorrection, StandardDeviationsByMonteCarlo) {
  Draws draws;
  Eigen::Matrix<double, 6, 6> mix;
  for (int i = 0; i < 36; ++i) mix(i / 6, i % 6) = draws.normal();
  mix.topRows<3>() *= 0.01, mix.bottomRows<3>() *= 30.0 * kArcsec;
  SystemMatrix covariance = SystemMatrix::Zero();
  covariance.topLeftCorner<6, 6>() = mix * mix.transpose();
  const SystemVector mean = biasesOf(0.1, -0.2, 0.3, 900, -700, 1200);
  for (const Program& program : programs()) {
    const Mounting old{Vector3d(0.7, -0.5, 1.9) / program.unit, {0.3, -1.2, 0.8}};
    const MountingCorrection correction =
        correctedMounting(program.convention, old, mean, covariance);
    Eigen::Matrix<double, 6, 6> sample = Eigen::Matrix<double, 6, 6>::Zero();
    constexpr int kDraws = 20000;
    for (int n = 0; n < kDraws; ++n) {
      Eigen::Matrix<double, 6, 1> unit, deviation;
      for (int i = 0; i < 6; ++i) unit[i] = draws.normal();
      SystemVector drawn = mean;
      drawn.head<6>() += mix * unit;
      const Mounting other = correctedMounting(program.convention, old, drawn).after;
      deviation << other.angles - correction.after.angles,
          other.lever_arm - correction.after.lever_arm;
      sample += deviation * deviation.transpose() / kDraws;
    }
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(correction.std(i) / std::sqrt(sample(i, i)), 1.0, 0.03)
          << program.convention.name << " " << i;
      for (int j = 0; j < i; ++j) {
        EXPECT_NEAR(
            (correction.covariance(i, j) - sample(i, j)) / (correction.std(i) * correction.std(j)),
            0.0, 0.04)
            << program.convention.name << " " << i << j;
      }
    }
  }
}

// At gimbal lock the angles have no standard deviations; near it those of the first and the third
// are large and honest; points are exact.
TEST(MountingCorrection, GimbalLock) {
  const MountingConvention& convention = mountingConventionNamed("zyx_frd");
  SystemMatrix covariance = SystemMatrix::Zero();
  covariance.diagonal().segment<3>(3).setConstant(std::pow(5.0 * kArcsec, 2));
  const MountingCorrection locked =
      correctedMounting(convention, {{10, 90, 20}, {1, 0, 0}}, SystemVector::Zero(), covariance);
  EXPECT_LT(locked.gimbal_sine, kGimbalLock);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isnan(locked.std(i)));
  EXPECT_NEAR(locked.std(4), 5.0 * kArcsec, 1e-9);
  EXPECT_LT(
      (rotationOf(convention, locked.after.angles) - rotationOf(convention, {10, 90, 20})).norm(),
      1e-14);
  const MountingCorrection near =
      correctedMounting(convention, {{10, 89, 20}, {1, 0, 0}}, SystemVector::Zero(), covariance);
  EXPECT_NEAR(near.gimbal_sine, std::sin(kRadiansPerDegree), 1e-12);
  EXPECT_NEAR(3600.0 * near.std(2), 5.0 / std::sin(kRadiansPerDegree), 1e-6);
  EXPECT_NEAR(3600.0 * near.std(1), 5.0, 1e-9);
}

// A range bias is applied along the pulse by a program and along the line from the body's origin by
// the corrector: they differ by up to range bias times lever arm over range.
TEST(MountingCorrection, RangeBiasActsAlongThePulse) {
  Draws draws;
  const Program program{mountingConventionNamed("novatel")};
  double largest = 0.0;
  for (int n = 0; n < 1000; ++n) {
    SystemVector bias = biasesOf(0, 0, 0, 100, -60, 80);
    bias[indexOf(SystemParameter::range_bias)] = 0.1;
    const Mounting old{{0.2, -0.1, 0.3}, Vector3d(0.5, 0.5, -0.7)};  // about 1 m
    const double angle = draws.uniform(-0.4, 0.4), range = 500.0;
    const Vector3d pulse(-std::sin(angle), 0.0, -std::cos(angle));
    const SensorPose pose = draws.pose();
    const auto point = [&](const Mounting& mounting, double length) -> Vector3d {
      return pose.position + pose.rotation * program.inBody(mounting, length * pulse);
    };
    const Mounting renewed = correctedMounting(program.convention, old, bias).after;
    largest = std::max(
        largest, (point(renewed, range - 0.1) - corrected(pose, point(old, range), bias)).norm());
  }
  EXPECT_LT(largest, 0.1 * 1.0 / 500.0);  // 0.2 mm
  EXPECT_GT(largest, 1e-5);
}

// A block that was computed with a wrong mounting: its points, recomputed with the new mounting,
// are those of the corrector, and the simulator's points without the bias.
TEST(MountingCorrection, PointsOfASimulatedBlock) {
  simulation::SimulationOptions options = simulation::SimulationOptions::preset("small", 0.2, 0.1);
  options.mounting = biasesOf(0.3, -0.2, 0.4, 3000, -2000, 4000);
  options.bias = biasesOf(0.1, 0.05, -0.1, 90, -100, 150);
  const simulation::Simulator simulator(options);
  const SystemVector assumed = options.mounting + options.bias;
  const Matrix3d assumed_turn = boresightRotation(assumed);
  // Biases of a calibration: B = M_assumed M_true', dP = P_assumed - B P_true.
  const Matrix3d b = assumed_turn * boresightRotation(options.mounting).transpose();
  SystemVector bias = SystemVector::Zero();
  bias.head<3>() = assumed.head<3>() - b * options.mounting.head<3>();
  bias.segment<3>(3) << std::asin(b(2, 1)), std::atan2(-b(2, 0), b(2, 2)),
      std::atan2(-b(0, 1), b(1, 1));

  const MountingConvention& convention = mountingConventionNamed("pcl_als");
  const Mounting old{assumed.segment<3>(3) / kArcsec, assumed.head<3>()};
  const Mounting renewed = correctedMounting(convention, old, bias).after;
  EXPECT_LT((renewed.angles - options.mounting.segment<3>(3) / kArcsec).norm(), 1e-6);
  EXPECT_LT((renewed.lever_arm - options.mounting.head<3>()).norm(), 1e-9);

  const Program program{convention, kArcsec};
  Trajectory::Options with_attitude;
  with_attitude.use_attitude = true;
  const Trajectory flight(simulator.trueTrajectory(), with_attitude);
  double from_corrector = 0.0, from_truth = 0.0;
  std::size_t points = 0, cursor = 0;
  for (const simulation::SimulatedPoint& point : simulator.strip(0)) {
    SensorPose pose;
    if (!flight.poseAt(point.time, pose, cursor)) continue;
    const Vector3d scanner =
        assumed_turn.transpose() *
        (pose.rotation.transpose() * (point.position - pose.position) - old.lever_arm);
    const Vector3d recomputed = pose.position + pose.rotation * program.inBody(renewed, scanner);
    from_corrector =
        std::max(from_corrector, (recomputed - corrected(pose, point.position, bias)).norm());
    from_truth = std::max(from_truth, (recomputed - point.unbiased).norm());
    ++points;
  }
  EXPECT_GT(points, 500U);
  EXPECT_LT(from_corrector, 3e-9);  // coordinates of 5 660 000 m have steps of 1e-9 m
  EXPECT_LT(from_truth, 1e-4);      // the trajectory is interpolated between its samples
}

TEST(MountingCorrection, RefusesWhatNoSensorHas) {
  const MountingConvention& convention = mountingConventionNamed("zyx_frd");
  EXPECT_THROW(correctedMounting(convention, {}, biasesOf(0, 0, 0, 30000, 0, 0)), UsageError);
  EXPECT_THROW(correctedMounting(convention, {}, biasesOf(200, 0, 0, 0, 0, 0)), UsageError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(correctedMounting(convention, {{0, nan, 0}, {0, 0, 0}}, SystemVector::Zero()),
               UsageError);
  EXPECT_THROW(correctedMounting(convention, {{0, 0, 0}, {0, nan, 0}}, SystemVector::Zero()),
               UsageError);
}

}  // namespace
}  // namespace pcl_als
