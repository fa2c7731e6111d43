// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/las_file.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_reference.h>

#include "file_kind.h"
#include "pcd_file.h"

namespace pcl_als {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 26U;

// Seconds of the week may run on past its end; as adjusted standard time these were September 2011.
constexpr double kLastWeekSecond = 2.0 * 604800.0;

/// What a PointChunk has columns for; the layers of other fields are not decoded.
constexpr unsigned kColumns = kLazZ | kLazClassification | kLazFlags | kLazIntensity |
                              kLazScanAngle | kLazPointSource | kLazGpsTime;

class LasPointReader : public PointReader {
 public:
  LasPointReader(const std::filesystem::path& path, OtherCoordinates other)
      : file_(path, kColumns), info_(file_.info()) {
    if (other == OtherCoordinates::refuse) requireMapCoordinates(info_);
    const Eigen::Vector3d metres = info_.units.metres();
    scaling_ = {file_.header().scale.cwiseProduct(metres),
                file_.header().offset.cwiseProduct(metres)};
  }

  const PointFileInfo& info() const override { return info_; }

  bool read(PointChunk& chunk) override {
    const LasHeader& header = file_.header();
    // Records may have up to 64 kB; a chunk of those is shorter.
    const std::size_t most = std::min(kChunk, kMostBytes / header.record_length);
    const std::size_t count = std::min<std::uint64_t>(most, header.point_count - position_);
    buffer_.resize(count * header.record_length);
    file_.readRecords(position_, count, buffer_.data());
    decodeLasRecords(buffer_.data(), count, header.record_length, file_.layout(), scaling_.scale,
                     scaling_.offset, chunk);
    position_ += count;
    return count > 0;
  }

 private:
  LasFile file_;
  PointFileInfo info_;
  LasScaling scaling_;
  std::uint64_t position_ = 0;
  std::vector<std::byte> buffer_;
};

/// A PCD header knows neither box nor kind of time: both come from a first pass over the points.
class PcdPointReader : public PointReader {
 public:
  explicit PcdPointReader(const std::filesystem::path& path) : file_(path) {
    info_.path = path;
    info_.crs = file_.header().crs;
    info_.crs_kind = describeCrs(info_.crs).kind;
    info_.units.source = info_.units.vertical_source = "PCD";
    info_.format = std::string("PCD ") + file_.header().dataName();
    survey();
    file_.rewind();
  }

  const PointFileInfo& info() const override { return info_; }

  bool read(PointChunk& chunk) override {
    // A block may hold invalid points only; the end is where the file ends.
    bool more = file_.read(kChunk, chunk);
    while (more && chunk.size() == 0) more = file_.read(kChunk, chunk);
    toGround(chunk);
    return more;
  }

 private:
  void toGround(PointChunk& chunk) const {
    const Eigen::Vector3d& origin = file_.header().viewpoint;
    for (double& x : chunk.x) x += origin.x();
    for (double& y : chunk.y) y += origin.y();
    for (double& z : chunk.z) z += origin.z();
  }

  void survey() {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
    bool in_week = true;
    PointChunk chunk;
    while (file_.read(kChunk, chunk)) {
      info_.point_count += chunk.size();
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        const Eigen::Vector3d point(chunk.x[i], chunk.y[i], chunk.z[i]);
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
        in_week = in_week && chunk.gps_time[i] >= 0.0 && chunk.gps_time[i] <= kLastWeekSecond;
      }
    }
    if (info_.point_count == 0) low = high = Eigen::Vector3d::Zero();
    info_.minimum = low + file_.header().viewpoint;
    info_.maximum = high + file_.header().viewpoint;
    const double largest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
    info_.resolution.setConstant(std::max(1e-6, largest * std::ldexp(1.0, -23)));
    if (file_.header().find("gps_time") != nullptr)
      info_.time_kind = in_week ? TimeKind::week_seconds : TimeKind::adjusted_standard;
  }

  detail::PcdFile file_;
  PointFileInfo info_;
};

}  // namespace

std::unique_ptr<PointReader> PointReader::open(const std::filesystem::path& path,
                                               OtherCoordinates other) {
  const std::string extension = detail::lowerExtension(path);
  if (extension == ".pcd") return std::make_unique<PcdPointReader>(path);
  if (extension == ".las" || extension == ".laz")
    return std::make_unique<LasPointReader>(path, other);
  throw InputError(path.string() + ": is no point file by its name (.las, .laz or .pcd)");
}

}  // namespace pcl_als
