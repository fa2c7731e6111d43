// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "point_sink.h"

#include <array>

#include <pcl_als/common/file_extension.h>
#include <pcl_als/io/exchange_writer.h>
#include <pcl_als/io/new_las_file.h>
#include <pcl_als/io/pcd_writer.h>
#include <pcl_als/las/las_selection.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/las/unclaimed_bytes.h>

namespace pcl_als::detail {
namespace {

namespace fs = std::filesystem;

/// Raw records into a file like that of the first of them.
class RecordSink : public PointSink {
 public:
  RecordSink(const fs::path& path, const fs::path& first, const SinkOptions& options)
      : like_(first, kLazAllFields,
              options.keep_readable ? LasDamage::keep_intact : LasDamage::refuse),
        writer_(path, like_, options.threads) {}

  void append(const PointBlock& block, std::size_t from, std::size_t to) override {
    const std::size_t length = like_.header().record_length;
    if (block.file->path() != last_) {
      steps_ = stepsBetween(*block.file, like_);
      last_ = block.file->path();
      const UnclaimedBytes unclaimed = unclaimedBytes(*block.file);
      if (last_ != like_.path() && unclaimed.any())
        remarks_.push_back(last_.string() + ": " + unclaimed.describe() + "; they are not copied");
    }
    std::byte* records = block.records + from * length;
    moveRecords(steps_, records, to - from, length, block.file->path().string());
    writer_.append(records, to - from);
  }
  std::uint64_t pointCount() const override { return writer_.pointCount(); }
  void finish() override { writer_.finish(); }
  std::vector<std::string> remarks() const override {
    std::vector<std::string> remarks = remarks_;
    for (const std::string& text : writer_.remarks())
      remarks.push_back(like_.path().string() + ": " + text);
    return remarks;
  }

 private:
  LasFile like_;
  LasSelectionWriter writer_;
  fs::path last_;  ///< file of the records that were appended last
  std::array<std::int64_t, 3> steps_{};
  std::vector<std::string> remarks_;  ///< of other files than the one that the output is like
};

PointChunk rowsOf(const PointChunk& chunk, std::size_t from, std::size_t to) {
  const auto part = [from, to](const auto& column) {
    return std::decay_t<decltype(column)>(column.begin() + static_cast<std::ptrdiff_t>(from),
                                          column.begin() + static_cast<std::ptrdiff_t>(to));
  };
  return {part(chunk.x),
          part(chunk.y),
          part(chunk.z),
          part(chunk.gps_time),
          part(chunk.intensity),
          part(chunk.scan_angle),
          part(chunk.point_source_id),
          part(chunk.return_number),
          part(chunk.number_of_returns),
          part(chunk.classification),
          part(chunk.flags),
          part(chunk.user_data),
          part(chunk.channel)};
}

LasWriterOptions optionsFor(const PointFileInfo& info, const LasVersion& version) {
  LasWriterOptions options = newLasOptions(info.crs, info.time_kind, info.minimum);
  options.version_minor = version.minor;
  options.time_offset = version.time_offset;
  if (!info.corrections.empty()) options.vlrs.push_back(lasCorrectionsVlr(info.corrections));
  return options;
}

/// Columns into a new LAS file.
class ColumnSink : public PointSink {
 public:
  ColumnSink(const fs::path& path, const PointFileInfo& info, const LasVersion& version)
      : writer_(path, optionsFor(info, version)) {}

  void append(const PointBlock& block, std::size_t from, std::size_t to) override {
    if (from == 0 && to == block.chunk.size())
      writer_.append(block.chunk);
    else
      writer_.append(rowsOf(block.chunk, from, to));
  }
  std::uint64_t pointCount() const override { return writer_.pointCount(); }
  void finish() override { writer_.finish(); }

 private:
  LasWriter writer_;
};

LocalFrame frameOf(const PointFileInfo& info) {
  const Eigen::Vector3d centre = 0.5 * (info.minimum + info.maximum);
  return LocalFrame::around(centre.allFinite() ? centre : Eigen::Vector3d::Zero(), info.crs);
}

class PcdSink : public PointSink {
 public:
  PcdSink(const fs::path& path, const PointFileInfo& info, const std::string& strip)
      : writer_(path, frameOf(info), strip, info.corrections) {}

  void append(const PointBlock& block, std::size_t from, std::size_t to) override {
    writer_.append(block.chunk, from, to);
  }
  std::uint64_t pointCount() const override { return writer_.pointCount(); }
  void finish() override { writer_.finish(); }

 private:
  PcdWriter writer_;
};

/// Columns into a PLY or XYZ file.
class ExchangeSink : public PointSink {
 public:
  ExchangeSink(const fs::path& path, const PointFileInfo& info, const SinkOptions& options)
      : writer_(path, info, {options.strip, options.ascii_ply}) {}

  void append(const PointBlock& block, std::size_t from, std::size_t to) override {
    writer_.append(block.chunk, from, to);
  }
  std::uint64_t pointCount() const override { return writer_.pointCount(); }
  void finish() override { writer_.finish(); }

 private:
  ExchangeWriter writer_;
};

}  // namespace

bool isPcd(const fs::path& path) {
  return lowerExtension(path) == ".pcd";
}

bool isLas(const fs::path& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".las" || extension == ".laz";
}

std::unique_ptr<PointSink> openSink(const fs::path& path, const fs::path& first,
                                    const PointFileInfo& info, const SinkOptions& options) {
  if (isPcd(path)) return std::make_unique<PcdSink>(path, info, options.strip);
  if (!isLas(path)) return std::make_unique<ExchangeSink>(path, info, options);
  if (options.records) return std::make_unique<RecordSink>(path, first, options);
  return std::make_unique<ColumnSink>(path, info, options.las_version);
}

std::string fieldsWithoutColumn(const LasFile& file, const fs::path& output) {
  std::string names;
  const LasRecordLayout& layout = file.layout();
  const auto add = [&names](bool lost, const std::string& name) {
    if (lost) names += (names.empty() ? "" : ", ") + name;
  };
  add(layout.rgb >= 0, "colours");
  add(layout.nir >= 0, "near infrared");
  add(layout.waveform >= 0, "waveforms");
  add(file.header().record_length > layout.length, "extra bytes");
  const UnclaimedBytes unclaimed = unclaimedBytes(file);
  add(unclaimed.any(), unclaimed.describe());
  if (names.empty()) return names;
  return file.path().string() + ": a " + lowerExtension(output) + " file does not store " + names;
}

}  // namespace pcl_als::detail
