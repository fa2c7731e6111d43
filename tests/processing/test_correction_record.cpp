// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/processing/file_correction.h>
#include <pcl_als/processing/file_motion.h>
#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/processing/point_conversion.h>

#include "file_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

/// A strip below a level flight to the north at 60 m/s, 1000 m above the ground.
class CorrectionRecord : public testing::Test {
 protected:
  CorrectionRecord() : folder_(test::scratch("correction_record")) {
    std::vector<TrajectorySample> samples(101);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples[i].time = 1000.0 + 0.1 * static_cast<double>(i);
      samples[i].position = {500000.0, 5400000.0 + 60.0 * (samples[i].time - 1000.0), 1000.0};
      samples[i].roll = samples[i].pitch = samples[i].heading = 0.0;
    }
    roll_ = biases(SystemParameter::boresight_roll, -90.0 * kRadiansPerArcsec);
    pitch_ = biases(SystemParameter::boresight_pitch, 30.0 * kRadiansPerArcsec);
    Trajectory::Options options;
    options.use_attitude = true;
    flight_ = std::make_shared<const Trajectory>(samples, options);
    original_ = write("original.las");
  }

  static CalibrationResult biases(SystemParameter parameter, double value) {
    CalibrationResult calibration;
    calibration[parameter].bias = value;
    calibration.attitude = AttitudeSource::trajectory;
    calibration.converged = true;
    return calibration;
  }

  fs::path write(const std::string& name) const {
    PointChunk chunk;
    chunk.resize(3000);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> across(-300.0, 300.0);
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      chunk.gps_time[i] = 1001.0 + 8.0 * static_cast<double>(i) / 3000.0;
      chunk.x[i] = 500000.0 + across(random);
      chunk.y[i] = 5400000.0 + 60.0 * (chunk.gps_time[i] - 1000.0);
      chunk.z[i] = 0.0;
      chunk.intensity[i] = 100;
      chunk.return_number[i] = chunk.number_of_returns[i] = 1;
    }
    LasWriterOptions las;
    las.offset = {500000.0, 5400000.0, 0.0};
    las.time_kind = TimeKind::week_seconds;
    LasWriter writer(folder_ / name, las);
    writer.append(chunk);
    writer.finish();
    return folder_ / name;
  }

  FileCorrectionResult correct(const fs::path& input, const std::string& output,
                               const CalibrationResult& calibration,
                               const FileCorrectionOptions& options = {}) const {
    return correctPointFile(input, folder_ / output, calibration, flight_, options);
  }

  AppliedCorrections recordOf(const std::string& file) const {
    return parseCorrections(PointReader::open(folder_ / file)->info().corrections);
  }

  fs::path folder_, original_;
  std::shared_ptr<const Trajectory> flight_;
  CalibrationResult roll_, pitch_;
};

TEST_F(CorrectionRecord, StatesTheCalibrationThatWasApplied) {
  correct(original_, "corrected.las", roll_);
  const AppliedCorrections record = recordOf("corrected.las");
  ASSERT_EQ(record.size(), 1U);
  EXPECT_EQ(record[0].kind, CorrectionKind::biases_removed);
  EXPECT_EQ(record[0].id, calibrationId(roll_));
  EXPECT_EQ(record[0].values, "boresight_roll -90 arcsec");
  EXPECT_NE(record[0].id, calibrationId(pitch_));
}

TEST_F(CorrectionRecord, RefusesTheSameCalibrationTwiceUnlessForced) {
  for (const char* name : {"once.las", "once.laz"}) {
    correct(original_, name, roll_);
    EXPECT_THROW(correct(folder_ / name, "twice.las", roll_), InputError);
    EXPECT_FALSE(fs::exists(folder_ / "twice.las"));
  }
  FileCorrectionOptions forced;
  forced.force = true;
  EXPECT_EQ(correct(folder_ / "once.laz", "twice.las", roll_, forced).warnings.size(), 1U);
  EXPECT_EQ(recordOf("twice.las").size(), 2U);
}

TEST_F(CorrectionRecord, WarnsOfAnotherCalibration) {
  correct(original_, "roll.las", roll_);
  const FileCorrectionResult result = correct(folder_ / "roll.las", "both.las", pitch_);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].text.find("boresight_roll -90 arcsec"), std::string::npos);
  EXPECT_EQ(recordOf("both.las").size(), 2U);
}

TEST_F(CorrectionRecord, AppliedBiasesAreRemovedAgainWithoutATrace) {
  FileCorrectionOptions inverse;
  inverse.invert = true;
  correct(original_, "biased.las", roll_, inverse);
  EXPECT_EQ(recordOf("biased.las").at(0).kind, CorrectionKind::biases_applied);
  EXPECT_THROW(correct(folder_ / "biased.las", "more.las", roll_, inverse), InputError);
  correct(folder_ / "biased.las", "back.las", roll_);
  EXPECT_TRUE(recordOf("back.las").empty());
  EXPECT_EQ(fs::file_size(folder_ / "back.las"), fs::file_size(original_));
}

TEST_F(CorrectionRecord, NothingIsRecordedWhereNothingChangesOrOnRequest) {
  correct(original_, "zero.las", biases(SystemParameter::boresight_roll, 0.0));
  EXPECT_EQ(test::readBytes(folder_ / "zero.las"), test::readBytes(original_));
  FileCorrectionOptions silent;
  silent.record = false;
  correct(original_, "silent.las", roll_, silent);
  EXPECT_TRUE(recordOf("silent.las").empty());
}

TEST_F(CorrectionRecord, SurvivesConversionBetweenFormats) {
  correct(original_, "a.las", roll_);
  fs::path from = folder_ / "a.las";
  for (const char* name : {"b.laz", "c.pcd", "d.las", "e.pcd", "f.laz"}) {
    convertPointFiles({from}, folder_ / name, {});
    ASSERT_EQ(recordOf(name).size(), 1U) << name;
    from = folder_ / name;
  }
  EXPECT_THROW(correct(folder_ / "e.pcd", "g.pcd", roll_), InputError);
  const std::vector<Strip<PointLidar>> strips = loadStrips({folder_ / "f.laz"});
  savePcd(folder_ / "strip.pcd", strips.at(0));
  EXPECT_EQ(recordOf("strip.pcd").size(), 1U);
}

TEST_F(CorrectionRecord, LeavesPointsAndOtherRecordsWhereTheyAre) {
  correct(original_, "plain.las", roll_);
  FileCorrectionOptions silent;
  silent.record = false;
  correct(original_, "silent.las", roll_, silent);
  const LasFile recorded(folder_ / "plain.las"), bare(folder_ / "silent.las");
  ASSERT_EQ(recorded.vlrs().size(), bare.vlrs().size() + 1);
  const std::size_t bytes = bare.header().record_length * bare.header().point_count;
  std::vector<std::byte> a(bytes), b(bytes);
  recorded.readRecords(0, bare.header().point_count, a.data());
  bare.readRecords(0, bare.header().point_count, b.data());
  EXPECT_EQ(a, b);
}

TEST_F(CorrectionRecord, FilesOfOneJobShouldBeCorrectedAlike) {
  correct(original_, "corrected.las", roll_);
  const std::string corrected = (folder_ / "corrected.las").string();
  EXPECT_EQ(commonReference({corrected}).remarks.size(), 2U);  // no unit is stated, corrected
  const std::vector<std::string> mixed = commonReference({corrected, original_.string()}).remarks;
  ASSERT_EQ(mixed.size(), 3U);
  EXPECT_NE(mixed.back().find("not corrected alike"), std::string::npos);
}

TEST_F(CorrectionRecord, RegistrationAndIntensityAreRecordedToo) {
  RigidMotion motion;
  motion.shift = {0.1, 0.0, 0.0};
  movePointFile(original_, folder_ / "moved.las", motion, 1);
  EXPECT_EQ(recordOf("moved.las").at(0).kind, CorrectionKind::rigid_motion);

  IntensityOptions options;
  options.output.keep_original = false;
  const auto correctedIntensity = [&](const fs::path& input, const fs::path& output) {
    correctIntensity({input.string()}, {output.string()}, flight_, options);
  };
  correctedIntensity(original_, folder_ / "intensity.las");
  EXPECT_EQ(recordOf("intensity.las").at(0).kind, CorrectionKind::intensity);
  EXPECT_THROW(correctedIntensity(folder_ / "intensity.las", folder_ / "again.las"), InputError);
  // Coordinates of such a file are those of the original.
  EXPECT_TRUE(correct(folder_ / "intensity.las", "both.las", roll_).warnings.empty());
}

TEST(CalibrationId, IsThatOfTheCalibrationReadFromItsFile) {
  CalibrationResult calibration;
  std::mt19937 random(1);
  std::normal_distribution<double> value;
  for (ParameterEstimate& parameter : calibration.parameters) {
    parameter.bias = 1e-4 * value(random);
    parameter.status = ParameterStatus::estimated;
  }
  calibration.strip_errors.push_back({"7", {}, {}});
  for (int i = 0; i < 1000; ++i) {
    TrajectoryErrorKnot knot;
    knot.time = 0.1 * i;
    knot.position = 0.01 * Eigen::Vector3d(value(random), value(random), value(random));
    knot.angles = 1e-5 * Eigen::Vector3d(value(random), value(random), value(random));
    calibration.strip_errors[0].knots.push_back(knot);
  }
  const fs::path file = test::scratch("calibration_id") / "calibration.json";
  writeCalibration(file, calibration);
  EXPECT_EQ(calibrationId(readCalibration(file)), calibrationId(calibration));
  calibration.parameters[0].bias *= 1.0001;
  EXPECT_NE(calibrationId(readCalibration(file)), calibrationId(calibration));
}

TEST(CorrectionsRecord, ReadsWhatItWritesAndFitsIntoAVlr) {
  AppliedCorrections corrections(200, {CorrectionKind::biases_removed, "id", true, "values \"x\""});
  for (AppliedCorrection& correction : corrections) correction.values.append(2000, 'y');
  corrections.back().id = "last";
  const std::string record = correctionsRecord(corrections);
  EXPECT_LT(record.size(), 65536U);
  EXPECT_EQ(record.find('\n'), std::string::npos);
  EXPECT_EQ(parseCorrections(record).back().id, "last");
  EXPECT_TRUE(parseCorrections(record).back().strip_corrections);
  EXPECT_TRUE(correctionsRecord({}).empty());
}

TEST(CorrectionsRecord, NamesOneThatCannotBeRead) {
  for (const char* text : {"{", "[]", "{\"corrections\":[1]}", "{\"corrections\":[{\"kind\":7}]}"})
    EXPECT_EQ(parseCorrections(text).at(0).kind, CorrectionKind::unreadable) << text;
}

}  // namespace
}  // namespace pcl_als
