// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/local_point_reader.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_file.h>

#include "pcd_file.h"

namespace pcl_als {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 26U;

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

/// A PCD header knows neither box nor kind of time.
class PcdPointReader : public LocalPointReader {
 public:
  explicit PcdPointReader(const std::filesystem::path& path) : file_(path) {
    info_.path = path;
    info_.crs = file_.header().crs;
    info_.units.source = info_.units.vertical_source = "PCD";
    info_.format = std::string("PCD ") + file_.header().dataName();
    survey(file_.header().viewpoint, file_.header().find("gps_time") != nullptr);
  }

 private:
  bool readLocal(PointChunk& chunk) override { return file_.read(kChunk, chunk); }
  void rewind() override { file_.rewind(); }

  detail::PcdFile file_;
};

}  // namespace

std::unique_ptr<PointReader> PointReader::open(const std::filesystem::path& path,
                                               OtherCoordinates other) {
  const std::string extension = lowerExtension(path);
  if (extension == ".pcd") return std::make_unique<PcdPointReader>(path);
  if (extension == ".las" || extension == ".laz")
    return std::make_unique<LasPointReader>(path, other);
  throw InputError(path.string() + ": is no point file by its name (.las, .laz or .pcd)");
}

}  // namespace pcl_als
