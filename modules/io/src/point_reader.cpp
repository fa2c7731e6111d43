// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/point_files.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/las_point_reader.h>
#include <pcl_als/io/local_point_reader.h>
#include <pcl_als/io/point_reader.h>

#include "pcd_file.h"
#include "xyz_file.h"

namespace pcl_als {
namespace {

/// What the comments in a file state.
void takeComments(const detail::PcdHeader& header, const std::string& format, PointFileInfo& info) {
  StatedCrs stated = usableCrs(header.crs);
  info.crs = std::move(stated.crs);
  info.crs_ignored = std::move(stated.ignored);
  info.units.source = info.units.vertical_source = format;
  info.corrections = header.corrections;
}

/// The header of a PCD or PLY knows neither box nor kind of time.
class PcdPointReader : public LocalPointReader {
 public:
  PcdPointReader(const std::filesystem::path& path, const PointWindow& window)
      : file_(path, window.channel_field) {
    const detail::PcdHeader& header = file_.header();
    info_.path = path;
    info_.version = file_.version();
    takeComments(header, header.kind, info_);
    info_.format = std::string(header.kind) + " " + header.dataName();
    info_.time_fault = file_.timeFault();
    survey(file_.origin(), file_.hasTimes(), file_.relativeStep());
  }
  std::vector<std::string> remarks() const override { return file_.remarks(); }

 private:
  bool readLocal(PointChunk& chunk) override { return file_.read(kChunk, chunk); }
  void rewind() override { file_.rewind(); }

  detail::PcdFile file_;
};

/// Text with a point in each line.
class XyzPointReader : public LocalPointReader {
 public:
  XyzPointReader(const std::filesystem::path& path, const PointWindow& window)
      : file_(path, window.columns, window.channel_field) {
    constexpr int kMostDecimals = 6;
    info_.path = path;
    info_.version = file_.version();
    takeComments(file_.comments(), "XYZ", info_);
    info_.format = "ASCII XYZ";
    survey(Eigen::Vector3d::Zero(), file_.hasTimes(), std::numeric_limits<double>::epsilon());
    info_.resolution.setConstant(std::pow(10.0, -std::min(file_.decimals(), kMostDecimals)));
  }
  std::vector<std::string> remarks() const override { return file_.remarks(); }

 private:
  bool readLocal(PointChunk& chunk) override { return file_.read(kChunk, chunk); }
  void rewind() override { file_.rewind(); }

  detail::XyzFile file_;
};

/// The points of another reader within bounds.
class BoundedReader : public PointReader {
 public:
  BoundedReader(std::unique_ptr<PointReader> reader, const PointWindow& window)
      : reader_(std::move(reader)), window_(window), info_(within(window, reader_->info())) {}

  const PointFileInfo& info() const override { return info_; }
  std::vector<std::string> remarks() const override { return reader_->remarks(); }

  bool read(PointChunk& chunk) override {
    bool more = reader_->read(chunk);
    for (; more; more = reader_->read(chunk)) {
      keepInside(*window_.bounds, chunk);
      if (chunk.size() > 0) break;
    }
    return more;
  }

 private:
  std::unique_ptr<PointReader> reader_;
  PointWindow window_;
  PointFileInfo info_;
};

}  // namespace

void requirePointFiles(std::size_t count) {
  if (count == 0) throw UsageError("no point files are given");
}

void requireCopyable(const std::filesystem::path& file) {
  const std::string extension = lowerExtension(file);
  if (extension == ".ply" || extension == ".xyz")
    throw InputError(
        file.string() + ": of " + extension +
        " files no corrected copies are written; convert it to .las, .laz or .pcd first");
}

std::unique_ptr<PointReader> PointReader::open(const std::filesystem::path& path,
                                               const PointWindow& window, OtherCoordinates other) {
  const std::string extension = lowerExtension(path);
  if (extension == ".las" || extension == ".laz")
    return std::make_unique<LasPointReader>(path, window, other);
  if (extension == ".pls")
    throw InputError(path.string() +
                     ": has pulses, not points; pcl_als_waveform writes their echoes as points");
  if (!isPointExtension(extension))
    throw InputError(path.string() + ": is no point file by its name (" + kPointExtensions + ")");
  if (window.resolution > 0.0)
    throw InputError(path.string() +
                     ": is no COPC file; only these can be read at a lower resolution");
  std::unique_ptr<PointReader> reader;
  if (extension == ".xyz")
    reader = std::make_unique<XyzPointReader>(path, window);
  else
    reader = std::make_unique<PcdPointReader>(path, window);
  if (!window.bounds) return reader;
  return std::make_unique<BoundedReader>(std::move(reader), window);
}

std::unique_ptr<PointReader> PointReader::open(const std::filesystem::path& path,
                                               OtherCoordinates other) {
  return open(path, PointWindow(), other);
}

}  // namespace pcl_als
