// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/las/las_file.h>

#include "test_files.h"

namespace pcl_als {
namespace {

using SbetRecord = std::array<double, 17>;
constexpr const char* kUtm11 = "EPSG:32611";

/// Flying over 37.77 north, 119.02 west: inside UTM zone 11, west of its central meridian.
SbetRecord record(double time) {
  return {time, 0.6592, -2.0773, 3000.0, 0, 0, 0, 0.01, -0.02, 1.0, 0.25, 0, 0, 0, 0, 0, 0};
}

std::filesystem::path sbetFile(const std::vector<SbetRecord>& records,
                               std::size_t extra_bytes = 0) {
  const auto path = test::scratch("sbet") / "flight.sbet";
  std::ofstream stream(path, std::ios::binary);
  for (const SbetRecord& r : records) {
    stream.write(reinterpret_cast<const char*>(r.data()), sizeof(SbetRecord));
  }
  stream << std::string(extra_bytes, '\0');
  return path;
}

std::string refusalOfSbet(const std::vector<SbetRecord>& records, const std::string& crs = kUtm11,
                          std::size_t extra_bytes = 0) {
  return test::messageOf<InputError>([&] { readTrajectory(sbetFile(records, extra_bytes), crs); });
}

#ifdef PCL_ALS_HAVE_PROJ

/// A record with one field replaced, after a good one.
std::vector<SbetRecord> withFault(std::size_t field, double value) {
  std::vector<SbetRecord> records{record(10.0), record(11.0)};
  records[1][field] = value;
  return records;
}

TEST(Sbet, CentralMeridianHasNoConvergenceAndEasting500Kilometres) {
  SbetRecord r = record(1.0);
  r[1] = 40.0 * kRadiansPerDegree, r[2] = -117.0 * kRadiansPerDegree;
  const auto samples = readTrajectory(sbetFile({r}), kUtm11);
  ASSERT_EQ(samples.size(), 1U);
  // 4 427 757.2188 m: 0.9996 times the meridian arc from the equator to 40 degrees on WGS 84.
  EXPECT_NEAR(samples[0].position.x(), 500000.0, 1e-6);
  EXPECT_NEAR(samples[0].position.y(), 0.9996 * 4429529.0302, 1e-3);
  EXPECT_EQ(samples[0].position.z(), 3000.0);
  EXPECT_EQ(samples[0].roll, 0.01);
  EXPECT_EQ(samples[0].pitch, -0.02);
  EXPECT_NEAR(samples[0].heading, 0.75, 1e-9);  // platform heading - wander angle
}

TEST(Sbet, HeadingIsFromGridNorth) {
  // Convergence of the Gauss-Krueger projection: dl sin(lat) (1 + dl^2 cos^2(lat) / 3 …), positive
  // east of the central meridian, where true north lies west of grid north.
  for (const double degrees : {-2.0, 2.0}) {
    SbetRecord r = record(1.0);
    const double latitude = 40.0 * kRadiansPerDegree, dl = degrees * kRadiansPerDegree;
    r[1] = latitude, r[2] = -117.0 * kRadiansPerDegree + dl;
    const double cosine = std::cos(latitude);
    const double convergence = dl * std::sin(latitude) * (1.0 + dl * dl * cosine * cosine / 3.0);
    // 2e-6: the next terms of the series.
    EXPECT_NEAR(readTrajectory(sbetFile({r}), kUtm11)[0].heading, 0.75 - convergence, 2e-6);
  }
}

TEST(Sbet, RefusesARecordThatLies) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    std::size_t field;
    double value;
    const char* expected;
  } cases[] = {
      {1, 1.6, "record 2: the latitude is beyond pi/2"},
      {2, -7.0, "record 2: the longitude is beyond 2 pi"},
      {3, 1e6, "record 2: the height is beyond 100 km"},
      {8, 500.0, "record 2: an attitude angle"},
      {16, nan, "record 2: a value is not a finite number"},
      {0, nan, "record 2: a value is not a finite number"},
      {0, 9.5, "record 2: the time runs backwards"},
      {0, 1e300, "record 2: the time is out of range"},
  };
  for (const auto& row : cases) {
    const std::string message = refusalOfSbet(withFault(row.field, row.value));
    EXPECT_NE(message.find(row.expected), std::string::npos) << row.expected << " / " << message;
  }
}

TEST(Sbet, RefusesACrsThatIsNoMap) {
  const std::vector<SbetRecord> records{record(1.0)};
  EXPECT_NE(refusalOfSbet(records, "EPSG:999999").find("PROJ does not know it"), std::string::npos);
  EXPECT_NE(refusalOfSbet(records, "nonsense").find("'nonsense'"), std::string::npos);
  EXPECT_NE(refusalOfSbet(records, "EPSG:4326").find("not a projected CRS"), std::string::npos);
  EXPECT_NE(refusalOfSbet(records, "EPSG:4978").find("not a projected CRS"), std::string::npos);
}

/// Over 37.77 north, 119.02 west: within zone 3 of California, given in feet and in metres.
TEST(Sbet, IsInMetresWhateverTheCrsCountsIn) {
  const std::vector<SbetRecord> records{record(1.0)};
  const TrajectorySample metres = readTrajectory(sbetFile(records), "EPSG:26943")[0];
  // Easting of the zone: 2 000 000 m at 120.5 degrees west.
  ASSERT_NEAR(metres.position.x(), 2130000.0, 10000.0);
  const TrajectorySample feet = readTrajectory(sbetFile(records), "EPSG:2227")[0];
  // 2e-4 m: the false easting of the zone in feet is rounded to 0.001 ft.
  EXPECT_NEAR(feet.position.x(), metres.position.x(), 2e-4);
  EXPECT_NEAR(feet.position.y(), metres.position.y(), 2e-4);
  EXPECT_DOUBLE_EQ(feet.position.z(), 3000.0);
  EXPECT_NEAR(feet.heading, metres.heading, 1e-9);
}

/// Heights above a geoid in feet: in metres if PROJ has a grid of the geoid, which here lies 21 to
/// 27 m below the ellipsoid; otherwise refused with the cause, and never passed on without the
/// geoid.
TEST(Sbet, HeightsInFeetAreBroughtToMetres) {
  const auto path = sbetFile({record(1.0)});
  double height = 0.0;
  const std::string message = test::messageOf<InputError>(
      [&] { height = readTrajectory(path, "EPSG:26943+6360")[0].position.z(); });
  const bool converted = message == "no error";
  EXPECT_NE(converted, message.find("geoid grid") != std::string::npos) << message;
  EXPECT_NEAR(height, converted ? 3024.0 : 0.0, converted ? 3.0 : 0.0);
}

TEST(Sbet, ATimeAcrossTheEndOfTheWeekRunsOn) {
  const auto samples = readTrajectory(sbetFile({record(604799.5), record(0.5)}), kUtm11);
  EXPECT_EQ(samples[1].time, 604800.5);
}

/// The file of the test data with the points it was recorded with.
struct Leeward {
  std::vector<SbetRecord> records;
  std::vector<TrajectorySample> samples;
  PointChunk points;

  static std::optional<Leeward> load() {
    const auto sbet = test::testData("leeward_sbet/sbet.out");
    const auto las = test::testData("leeward_sbet/points.las");
    if (!sbet || !las) return std::nullopt;
    Leeward data;
    data.samples = readTrajectory(*sbet, kUtm11);
    data.records.resize(std::filesystem::file_size(*sbet) / sizeof(SbetRecord));
    std::ifstream(*sbet, std::ios::binary)
        .read(reinterpret_cast<char*>(data.records.data()),
              static_cast<std::streamsize>(data.records.size() * sizeof(SbetRecord)));
    const LasFile file(*las);
    const auto count = static_cast<std::size_t>(file.header().point_count);
    std::vector<std::byte> raw(count * file.header().record_length);
    file.readRecords(0, count, raw.data());
    decodeLasRecords(raw.data(), count, file.header().record_length, file.layout(),
                     file.header().scale, file.header().offset, data.points);
    return data;
  }

  /// From the sensor to a point in the body frame (right-forward-up) at the sample next in time.
  Eigen::Vector3d inBody(std::size_t point) const {
    const double step = (points.gps_time[point] - samples.front().time) / 0.005;
    const auto last = static_cast<double>(samples.size() - 1);
    const auto& s = samples[static_cast<std::size_t>(std::clamp(std::round(step), 0.0, last))];
    const Eigen::Matrix3d ground_from_body =
        (Eigen::AngleAxisd(-s.heading, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(s.pitch, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(s.roll, Eigen::Vector3d::UnitY()))
            .toRotationMatrix();
    const Eigen::Vector3d ground(points.x[point], points.y[point], points.z[point]);
    return ground_from_body.transpose() * (ground - s.position);
  }
};

/// Line y = offset + slope x through points, and the root mean square of what is left.
struct Regression {
  double slope, offset, rms;

  Regression(const std::vector<double>& x, const std::vector<double>& y) {
    const Eigen::Map<const Eigen::ArrayXd> xs(x.data(), static_cast<Eigen::Index>(x.size()));
    const Eigen::Map<const Eigen::ArrayXd> ys(y.data(), static_cast<Eigen::Index>(y.size()));
    const Eigen::ArrayXd dx = xs - xs.mean(), dy = ys - ys.mean();
    slope = (dx * dy).sum() / dx.square().sum();
    offset = ys.mean() - slope * xs.mean();
    rms = std::sqrt((dy - slope * dx).square().mean());
  }
};

TEST(Sbet, LeewardTimesHeightAndWander) {
  const auto data = Leeward::load();
  PCL_ALS_REQUIRE_DATA(data);
  ASSERT_EQ(data->samples.size(), 200U);
  EXPECT_NEAR(data->samples.front().time, 400825.001, 1e-3);
  EXPECT_NEAR(data->samples.back().time, 400825.997, 1e-3);
  EXPECT_NEAR(data->samples.front().position.z(), 6992.0, 0.5);
  EXPECT_NEAR(data->records[100][10] / kRadiansPerDegree, 1.02, 0.005);
}

TEST(Sbet, LeewardHeadingTrackAndCrab) {
  const auto data = Leeward::load();
  PCL_ALS_REQUIRE_DATA(data);
  const auto &first = data->samples.front(), &last = data->samples.back();
  const Eigen::Vector3d flown = last.position - first.position;
  const double grid_track = std::atan2(flown.x(), flown.y()) / kRadiansPerDegree;
  const SbetRecord& r = data->records[100];
  const double grid_heading = data->samples[100].heading / kRadiansPerDegree;
  const double true_heading = (r[9] - r[10]) / kRadiansPerDegree;
  const double convergence = true_heading - grid_heading;  // west of the central meridian: < 0
  EXPECT_NEAR(true_heading, 164.0, 0.5);
  EXPECT_NEAR(grid_track + convergence, 158.5, 0.5);
  EXPECT_NEAR(grid_heading - grid_track, 5.5, 0.3);
  // -2.03 degrees of longitude from the central meridian times sin(37.77 degrees).
  EXPECT_NEAR(convergence, (r[2] / kRadiansPerDegree + 117.0) * std::sin(r[1]), 0.01);
  EXPECT_LT(convergence, -1.0);
}

TEST(Sbet, LeewardLookAnglesAgreeWithRecordedScanAngles) {
  const auto data = Leeward::load();
  PCL_ALS_REQUIRE_DATA(data);
  std::vector<double> look, recorded, right, forward;
  double nearest = 1e9, farthest = 0.0;
  for (std::size_t i = 0; i < data->points.size(); ++i) {
    const Eigen::Vector3d beam = data->inBody(i);
    look.push_back(std::atan2(beam.x(), -beam.z()) / kRadiansPerDegree);
    recorded.push_back(data->points.scan_angle[i]);
    right.push_back(beam.x()), forward.push_back(beam.y());
    nearest = std::min(nearest, beam.norm()), farthest = std::max(farthest, beam.norm());
  }
  const Regression line(look, recorded);
  EXPECT_NEAR(line.slope, 1.00, 0.005);
  EXPECT_NEAR(line.rms, 0.30, 0.005);  // whole degrees: 1 / sqrt(12) = 0.29
  EXPECT_NEAR(nearest, 4450.0, 10.0);
  EXPECT_NEAR(farthest, 5350.0, 10.0);
  // A wrong sign of wander (2.0 degrees) or convergence (2.4) would turn the scan line by that.
  EXPECT_NEAR(std::atan(Regression(right, forward).slope) / kRadiansPerDegree, -13.6, 0.5);
}

#else

TEST(Sbet, WithoutProjItSaysSo) {
  EXPECT_NE(refusalOfSbet({record(1.0)}).find("needs PROJ"), std::string::npos);
}

#endif

TEST(Sbet, RefusesASizeThatIsNoMultipleOfARecord) {
  EXPECT_NE(refusalOfSbet({record(1.0)}, kUtm11, 5).find("141 bytes, is not a multiple of the 136"),
            std::string::npos);
  EXPECT_NE(refusalOfSbet({}, kUtm11).find("is empty"), std::string::npos);
}

TEST(Sbet, WithoutACrsTheRemedyIsNamed) {
  try {
    readTrajectory(sbetFile({record(1.0)}));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("name no CRS"), std::string::npos) << error.what();
    EXPECT_EQ(error.hint(), Hint::crs);
  }
}

}  // namespace
}  // namespace pcl_als
