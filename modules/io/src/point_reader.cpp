// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/las_point_reader.h>
#include <pcl_als/io/local_point_reader.h>
#include <pcl_als/io/point_reader.h>

#include "pcd_file.h"

namespace pcl_als {
namespace {

/// A PCD header knows neither box nor kind of time.
class PcdPointReader : public LocalPointReader {
 public:
  PcdPointReader(const std::filesystem::path& path, const PointWindow& window)
      : file_(path, window.channel_field) {
    info_.path = path;
    info_.version = file_.version();
    StatedCrs stated = usableCrs(file_.header().crs);
    info_.crs = std::move(stated.crs);
    info_.crs_ignored = std::move(stated.ignored);
    info_.units.source = info_.units.vertical_source = "PCD";
    info_.corrections = file_.header().corrections;
    info_.format = std::string("PCD ") + file_.header().dataName();
    info_.time_fault = file_.timeFault();
    survey(file_.origin(), file_.hasTimes(), file_.relativeStep());
  }
  std::vector<std::string> remarks() const override { return file_.remarks(); }

 private:
  bool readLocal(PointChunk& chunk) override { return file_.read(kChunk, chunk); }
  void rewind() override { file_.rewind(); }

  detail::PcdFile file_;
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

std::unique_ptr<PointReader> PointReader::open(const std::filesystem::path& path,
                                               const PointWindow& window, OtherCoordinates other) {
  const std::string extension = lowerExtension(path);
  if (extension == ".las" || extension == ".laz")
    return std::make_unique<LasPointReader>(path, window, other);
  if (extension == ".pcd") {
    if (window.resolution > 0.0)
      throw InputError(path.string() +
                       ": is no COPC file; only these can be read at a lower resolution");
    auto reader = std::make_unique<PcdPointReader>(path, window);
    if (!window.bounds) return reader;
    return std::make_unique<BoundedReader>(std::move(reader), window);
  }
  throw InputError(path.string() + ": is no point file by its name (.las, .laz or .pcd)");
}

std::unique_ptr<PointReader> PointReader::open(const std::filesystem::path& path,
                                               OtherCoordinates other) {
  return open(path, PointWindow(), other);
}

}  // namespace pcl_als
