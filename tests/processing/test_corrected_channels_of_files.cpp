// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Calibrations whose systems are channels of a scanner: LAS files, PCD files and clouds with the
// same points are corrected alike, and points without the field of the channel are refused.
#include <filesystem>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/processing/file_correction.h>

#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

constexpr double kStep = 0.001;  // of the coordinates of the LAS files, metres
// Rounded to steps in the LAS, to floats in the cloud.
constexpr double kResolution = 1.5 * kStep;

/// Sixty seconds of a level flight to the north, 1000 m above the ground, and 6000 points of strip
/// 7 below it. Every other point is of the second channel, in each of the fields.
class ChannelsOfFiles : public testing::Test {
 protected:
  ChannelsOfFiles() : folder_(test::scratch("channels_of_files")) {
    std::vector<TrajectorySample> samples(601);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples[i].time = 1000.0 + 0.1 * static_cast<double>(i);
      samples[i].position = {500000.0, 5400000.0 + 60.0 * (samples[i].time - 1000.0), 1000.0};
    }
    flight_ = std::make_shared<const Trajectory>(samples);
    points_.resize(6000);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double time = 1000.5 + 0.009 * static_cast<double>(i);
      const std::uint8_t second = i % 2;
      points_.x[i] = 500000.0 + 450.0 * std::sin(0.7 * static_cast<double>(i));
      points_.y[i] = 5400000.0 + 60.0 * (time - 1000.0);
      points_.z[i] = 0.01 * static_cast<double>(i % 500);
      points_.gps_time[i] = time;
      points_.point_source_id[i] = 7;
      points_.return_number[i] = points_.number_of_returns[i] = 1;
      points_.flags[i] = static_cast<std::uint8_t>(second << 6U);
      points_.user_data[i] = static_cast<std::uint8_t>(4 + second);
      beams_.push_back(20.0 + second);
    }
  }

  fs::path las(const std::string& name, int point_format = 6) const {
    LasWriterOptions options;
    options.point_format = point_format;
    options.offset = {500000.0, 5400000.0, 0.0};
    options.scale.setConstant(kStep);
    options.time_kind = TimeKind::week_seconds;
    LasExtraField beam;
    beam.name = "beam";
    beam.type = LasExtraType::u16;
    beam.scale = 0.5;  // stored as 40 and 42
    options.extra_fields = {beam};
    PointChunk stored = points_;
    if (point_format < 6) std::fill(stored.flags.begin(), stored.flags.end(), std::uint8_t{0});
    LasWriter writer(folder_ / name, options);
    writer.append(stored, {beams_});
    writer.finish();
    return folder_ / name;
  }

  /// The points of the LAS file as a cloud, and with the beams as a PCD file.
  fs::path pcd(const std::string& name, const Strip<PointLidar>& strip) const {
    savePcd(folder_ / name, strip, {{"beam", {beams_.begin(), beams_.end()}}});
    return folder_ / name;
  }

  /// One system for each channel; only the second one has biases.
  static CalibrationResult byChannel(const std::string& field, int first) {
    CalibrationResult calibration;
    calibration.converged = true;
    calibration.channel_field = field;
    for (const int channel : {first, first + 1}) {
      SystemEstimate& system = calibration.systems.emplace_back();
      system.group = {std::to_string(channel), {channelStrip("7", channel)}};
    }
    SystemEstimate& second = calibration.systems.back();
    second.parameters[indexOf(SystemParameter::boresight_roll)].bias = 200.0 * kRadiansPerArcsec;
    second.parameters[indexOf(SystemParameter::range_bias)].bias = 0.2;
    return calibration;
  }

  fs::path corrected(const fs::path& input, const CalibrationResult& calibration,
                     const std::string& name, bool invert = false) const {
    FileCorrectionOptions options;
    options.invert = invert;
    correctPointFile(input, folder_ / name, calibration, flight_, options);
    return folder_ / name;
  }

  /// Expects the movements of the points of the LAS file to be those of the cloud.
  void expectAlike(const Strip<PointLidar>& before, const Strip<PointLidar>& las,
                   const LocalFrame& frame, const pcl::PointCloud<PointLidar>& cloud) const {
    ASSERT_EQ(las.cloud->size(), points_.size());
    ASSERT_EQ(cloud.size(), points_.size());
    double least = 1e9;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d at = before.frame.toGround((*before.cloud)[i].getVector3fMap());
      const Eigen::Vector3d by_las = las.frame.toGround((*las.cloud)[i].getVector3fMap()) - at;
      const Eigen::Vector3d by_cloud = frame.toGround(cloud[i].getVector3fMap()) - at;
      ASSERT_LT((by_las - by_cloud).norm(), kResolution) << i;
      if (i % 2 == 0)
        ASSERT_LT(by_las.norm(), kResolution) << i;
      else
        least = std::min(least, by_las.norm());
    }
    EXPECT_GT(least, 0.15);
  }

  std::string refusal(const fs::path& input, const CalibrationResult& calibration) const {
    const std::string name = "refused" + input.extension().string();
    const std::string message =
        test::messageOf<InputError>([&] { corrected(input, calibration, name); });
    EXPECT_FALSE(fs::exists(folder_ / name));
    return message;
  }

  fs::path folder_;
  std::shared_ptr<const Trajectory> flight_;
  PointChunk points_;
  std::vector<double> beams_;
};

TEST_F(ChannelsOfFiles, LasPcdAndCloudsAreCorrectedAlike) {
  const fs::path input = las("points.las");
  const Strip<PointLidar> strip = loadStrips({input.string()}).front();
  const fs::path cloud = pcd("points.pcd", strip);
  for (const auto& [field, first] :
       {std::pair("scanner_channel", 0), std::pair("user_data", 4), std::pair("beam", 20)}) {
    SCOPED_TRACE(field);
    const CalibrationResult calibration = byChannel(field, first);
    const Strip<PointLidar> by_las =
        loadStrips({corrected(input, calibration, "by_las.las").string()}).front();
    const Strip<PointLidar> by_pcd = loadPcd(corrected(cloud, calibration, "by_pcd.pcd"));
    expectAlike(strip, by_las, by_pcd.frame, *by_pcd.cloud);

    SystemBiasCorrection<PointLidar> filter;
    filter.setTrajectory(flight_);
    filter.setCalibration(calibration);
    filter.setLocalFrame(strip.frame);
    filter.setInputCloud(strip.cloud);
    if (field == std::string("beam")) filter.setChannels({beams_.begin(), beams_.end()});
    pcl::PointCloud<PointLidar> by_filter;
    filter.filter(by_filter);
    expectAlike(strip, by_las, strip.frame, by_filter);
  }
}

TEST_F(ChannelsOfFiles, CopiesOfPcdFilesKeepTheFieldOfTheChannel) {
  const Strip<PointLidar> strip = loadStrips({las("kept.las").string()}).front();
  const CalibrationResult calibration = byChannel("beam", 20);
  const fs::path removed = corrected(pcd("kept.pcd", strip), calibration, "removed.pcd");
  const Strip<PointLidar> back = loadPcd(corrected(removed, calibration, "back.pcd", true));
  const Strip<PointLidar> moved = loadPcd(removed);
  EXPECT_GT(((*moved.cloud)[1].getVector3fMap() - (*strip.cloud)[1].getVector3fMap()).norm(), 0.1F);
  for (std::size_t i = 0; i < points_.size(); ++i)
    ASSERT_LT(((*back.cloud)[i].getVector3fMap() - (*strip.cloud)[i].getVector3fMap()).norm(),
              1e-3F);
}

TEST_F(ChannelsOfFiles, PointsWithoutTheFieldOfTheChannelAreRefused) {
  const fs::path input = las("fields.las"), early = las("early.las", 1);
  const Strip<PointLidar> strip = loadStrips({input.string()}).front();
  const CalibrationResult by_flags = byChannel("scanner_channel", 0);
  EXPECT_NE(refusal(input, byChannel("mirror", 0)).find("no field 'mirror'"), std::string::npos);
  EXPECT_NE(refusal(pcd("fields.pcd", strip), byChannel("mirror", 0)).find("no field 'mirror'"),
            std::string::npos);
  EXPECT_NE(refusal(early, by_flags).find("field scanner_channel"), std::string::npos);

  const fs::path plain = folder_ / "plain.pcd";
  std::ofstream(plain) << "VERSION .7\nFIELDS x y z gps_time point_source_id\nSIZE 4 4 4 8 2\n"
                          "TYPE F F F F U\nCOUNT 1 1 1 1 1\nWIDTH 1\nHEIGHT 1\n"
                          "VIEWPOINT 500000 5400000 0 1 0 0 0\nPOINTS 1\nDATA ascii\n"
                          "10 60 5 1001 7\n";
  EXPECT_NE(refusal(plain, by_flags).find("field scanner_channel"), std::string::npos);
  EXPECT_NE(refusal(plain, byChannel("user_data", 4)).find("no field 'user_data'"),
            std::string::npos);

  // So are those without what an error source depends on.
  for (const auto& [source, field] :
       {std::pair(ErrorSource::mirror_torsion, "field flags"),
        std::pair(ErrorSource::intensity_ranging, "field intensity")}) {
    CalibrationResult calibration;
    calibration.sources[indexOf(source)] = 1e-4;
    EXPECT_NE(refusal(plain, calibration).find(field), std::string::npos);
  }

  // Where no channel but 0 is named, points without the field are of channel 0.
  CalibrationResult only_one = by_flags;
  only_one.systems[0].group.strips = {"9.ch0"};
  only_one.systems[1].group.strips = {"7.ch0"};
  const Strip<PointLidar> moved =
      loadStrips({corrected(early, only_one, "early_corrected.las").string()}).front();
  const Eigen::Vector3d before = strip.frame.toGround((*strip.cloud)[0].getVector3fMap());
  EXPECT_GT((moved.frame.toGround((*moved.cloud)[0].getVector3fMap()) - before).norm(), 0.15);
  EXPECT_NO_THROW(corrected(plain, only_one, "plain_corrected.pcd"));
}

// Files in LAS 1.4 compatibility mode have the scanner channel in extra bytes.
TEST_F(ChannelsOfFiles, CompatibilityModeIsCorrectedAsLas14) {
  const std::pair<const char*, LasExtraType> fields[] = {
      {"LAS 1.4 scan angle", LasExtraType::i16},
      {"LAS 1.4 extended returns", LasExtraType::u8},
      {"LAS 1.4 classification", LasExtraType::u8},
      {"LAS 1.4 flags and channel", LasExtraType::u8}};
  LasWriterOptions options;
  options.version_minor = 2;
  options.point_format = 1;
  options.offset = {500000.0, 5400000.0, 0.0};
  options.scale.setConstant(kStep);
  options.time_kind = TimeKind::week_seconds;
  std::vector<std::vector<double>> columns(4, std::vector<double>(points_.size(), 0.0));
  for (const auto& [name, type] : fields) {
    LasExtraField& field = options.extra_fields.emplace_back();
    field.name = name;
    field.type = type;
  }
  for (std::size_t i = 0; i < points_.size(); ++i)
    columns[3][i] = static_cast<double>((points_.flags[i] >> 6U) << 1U);
  PointChunk early = points_;
  std::fill(early.flags.begin(), early.flags.end(), std::uint8_t{0});
  LasWriter writer(folder_ / "compatible.las", options);
  writer.append(early, columns);
  writer.finish();

  const CalibrationResult calibration = byChannel("scanner_channel", 0);
  const auto expected =
      loadStrips({corrected(las("new.las"), calibration, "new_out.las").string()});
  const auto found = loadStrips(
      {corrected(folder_ / "compatible.las", calibration, "compatible_out.las").string()});
  for (std::size_t i = 0; i < points_.size(); ++i)
    ASSERT_EQ((*found[0].cloud)[i].getVector3fMap(), (*expected[0].cloud)[i].getVector3fMap()) << i;
}

}  // namespace
}  // namespace pcl_als
