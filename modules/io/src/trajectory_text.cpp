// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/time_scale.h>

#include "csv_table.h"
#include "leap_seconds.h"
#include "quaternion_attitude.h"
#include "trajectory_columns.h"
#include "trajectory_records.h"

namespace pcl_als::detail {
namespace {

using Quantity = TrajectoryQuantity;

/// One record after the other, as the columns say.
class RecordReader {
 public:
  RecordReader(const CsvTable& table, const TrajectoryColumns& columns,
               const TrajectoryReading& reading)
      : table_(table), columns_(columns), reading_(reading), place_(columns.place()) {
    if (!columns_[Quantity::time].present() && !reading_.leap_seconds && !hasWeek() &&
        !columns_[Quantity::date].present()) {
      throw InputError(table.at("its times are UTC, which lags GPS time by leap seconds, and no "
                                "GPS week or date says by "
                                "how many (18 since 2017)"),
                       Hint::leap_seconds);
    }
  }

  bool hasWeek() const { return columns_[Quantity::week].present(); }

  TrajectorySample sample() const {
    TrajectorySample sample;
    sample.time = time();
    for (int axis = 0; axis < 3; ++axis) {
      const Quantity quantity = place_[static_cast<std::size_t>(axis)];
      const TrajectoryColumn& column = columns_[quantity];
      const bool angle = quantity == Quantity::latitude || quantity == Quantity::longitude;
      sample.position[axis] =
          (angle ? table_.sexagesimal(column.index) : table_.number(column.index)) * column.factor;
    }
    if (columns_.attitude() == AttitudeForm::quaternion) {
      takeQuaternion(sample);
      return sample;
    }
    angle(Quantity::roll, sample.roll);
    angle(Quantity::pitch, sample.pitch);
    angle(Quantity::heading, sample.heading);
    return sample;
  }

  TrajectoryAccuracy accuracy(double time) const {
    TrajectoryAccuracy accuracy;
    accuracy.time = time;
    angle(Quantity::sd_east, accuracy.position.x());
    angle(Quantity::sd_north, accuracy.position.y());
    angle(Quantity::sd_up, accuracy.position.z());
    angle(Quantity::sd_roll, accuracy.angles.x());
    angle(Quantity::sd_pitch, accuracy.angles.y());
    angle(Quantity::sd_heading, accuracy.angles.z());
    return accuracy;
  }
  bool hasAccuracy() const {
    return columns_[Quantity::sd_east].present() || columns_[Quantity::sd_roll].present();
  }

 private:
  double time() const {
    const bool utc = !columns_[Quantity::time].present();
    double time =
        secondsOfTime(table_.number(columns_[utc ? Quantity::utc_time : Quantity::time].index));
    if (columns_[Quantity::date].present() && time < 2.0 * kSecondsPerWeek)
      time += dayOf(time);  // GPS seconds, whatever their size
    else if (probableTimeScales({time, time}).front() == TimeScale::unix_time)
      return time;
    // A time beyond two weeks holds its week already.
    if (hasWeek() && std::abs(time) < 2.0 * kSecondsPerWeek)
      time += table_.number(columns_[Quantity::week].index) * kSecondsPerWeek;
    if (reading_.leap_seconds) return time + *reading_.leap_seconds;
    return utc ? time + leapSecondsAt(time) : time;
  }
  /// GPS seconds at the start of the day of a record, whose time is in seconds of that day. Seconds
  /// of the week, which the first record shows, count from the Sunday before.
  double dayOf(double time) const {
    constexpr double kDay = 86400.0;
    const TrajectoryColumn& column = columns_[Quantity::date];
    const auto day = daysOfGps(table_.text(column.index), column.unit);
    if (!day)
      table_.refuse(column.index,
                    "is no date whose order is known; give year-month-day, or name the order in "
                    "the header: Date(YMD), Date(DMY) or Date(MDY)");
    if (!of_week_) of_week_ = time >= kDay;
    const double since_sunday = static_cast<double>(*day % 7) * kDay;
    if (*of_week_ && std::floor(time / kDay) != static_cast<double>(*day % 7))
      table_.refuse(column.index, "is not the day of the week of its time");
    return static_cast<double>(*day) * kDay - (*of_week_ ? since_sunday : 0.0);
  }
  /// Roll, pitch and heading as those of north, east, down.
  void takeQuaternion(TrajectorySample& sample) const {
    Eigen::Vector4d wxyz;
    for (int i = 0; i < 4; ++i) {
      const auto part = static_cast<Quantity>(static_cast<int>(Quantity::quaternion_w) + i);
      wxyz[i] = table_.numberOrNan(columns_[part].index);
    }
    if (wxyz.hasNaN()) return;  // an unknown attitude
    const std::optional<Eigen::Vector3d> angles = anglesOfQuaternion(wxyz);
    if (!angles) {
      char text[120];
      std::snprintf(text, sizeof text,
                    "the norm of its quaternion is %.4g, not 1: these are no attitudes",
                    wxyz.norm());
      throw InputError(table_.at(text));
    }
    sample.roll = angles->x(), sample.pitch = angles->y(), sample.heading = angles->z();
  }
  void angle(Quantity quantity, double& value) const {
    const TrajectoryColumn& column = columns_[quantity];
    if (column.present()) value = table_.numberOrNan(column.index) * column.factor;
  }

  const CsvTable& table_;
  const TrajectoryColumns& columns_;
  const TrajectoryReading& reading_;
  std::array<Quantity, 3> place_;
  mutable std::optional<bool> of_week_;  ///< with a date: times are seconds of the week
};

}  // namespace

TrajectoryRecords readTextTrajectory(const std::filesystem::path& path,
                                     const TrajectoryReading& reading) {
  CsvTable table(path, {&TrajectoryColumns::recognise, &TrajectoryColumns::isGeodetic,
                        reading.columns, Hint::columns});
  const TrajectoryColumns columns(table, reading.angles, !reading.crs.empty());
  const RecordReader reader(table, columns, reading);
  TrajectoryRecords records;
  records.format = columns[Quantity::reconstructed].present() ? kReconstructedFormat : "text";
  records.coordinates = columns.coordinates();
  records.attitude = columns.attitude();
  records.heading_is_true = columns.headingIsTrue();
  records.orthometric = columns.orthometric();
  records.columns = columns.describe();
  records.places.lines = true;
  while (table.next()) {
    records.samples.push_back(reader.sample());
    records.places.numbers.push_back(static_cast<std::uint32_t>(table.line()));
    if (reader.hasAccuracy())
      records.accuracy.push_back(reader.accuracy(records.samples.back().time));
  }
  if (records.samples.empty()) throw InputError(path.string() + ": has a header but no records");
  if (columns[Quantity::date].present())
    records.remarks.push_back("times are those of the date of each record");
  if (reader.hasWeek()) records.remarks.push_back("times hold the GPS week of the file");
  return records;
}

}  // namespace pcl_als::detail
