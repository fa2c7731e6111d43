// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/io/new_las_file.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/strip_writer.h>

#include "column_fields.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using Strips = std::vector<StripWithColumns>;

void checkStrips(const std::string& name, const Strips& strips) {
  const bool any = std::any_of(strips.begin(), strips.end(),
                               [](const auto& strip) { return !strip.cloud->empty(); });
  if (!any) throw UsageError(name + ": no points are given");
  for (const StripWithColumns& strip : strips) {
    if (strip.frame.crs != strips.front().frame.crs)
      throw UsageError(name + ": strips " + strips.front().id + " and " + strip.id +
                       " are in different CRS");
    for (const PointColumn& column : strip.columns) {
      if (column.values.size() != strip.cloud->size())
        throw UsageError(name + ": column " + column.field.name + " of strip " + strip.id +
                         " is not as long as the strip");
    }
  }
}

/// The point source id of the points of a strip that have none: its number, or 0.
std::uint16_t numberOf(const StripWithColumns& strip) {
  for (const PointLidar& point : *strip.cloud)
    if (point.point_source_id != 0) return 0;
  const std::string& id = strip.id;
  const bool number =
      !id.empty() && id.size() <= 5 &&
      std::all_of(id.begin(), id.end(), [](char c) { return c >= '0' && c <= '9'; });
  const unsigned long value = number ? std::stoul(id) : 0;
  return value <= 65535 ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
}

/// UsageError for several strips of which the file would make one.
void checkNumbers(const std::string& name, const Strips& strips,
                  const std::vector<std::uint16_t>& numbers) {
  std::set<std::string> unnumbered;
  for (std::size_t s = 0; s < strips.size(); ++s) {
    const bool without = std::any_of(strips[s].cloud->begin(), strips[s].cloud->end(),
                                     [](const auto& point) { return point.point_source_id == 0; });
    if (numbers[s] == 0 && without) unnumbered.insert(strips[s].id);
  }
  if (unnumbered.size() < 2) return;
  throw UsageError(name + ": strips " + *unnumbered.begin() + " and " + *unnumbered.rbegin() +
                   " could not be told apart: their points need a point_source_id, or a file each");
}

/// The columns of all strips that become extra bytes, by name.
std::vector<LasExtraField> extraFieldsOf(const Strips& strips) {
  std::vector<LasExtraField> fields;
  for (const StripWithColumns& strip : strips) {
    for (const PointColumn& column : strip.columns) {
      const bool known = std::any_of(fields.begin(), fields.end(), [&](const LasExtraField& field) {
        return field.name == column.field.name;
      });
      if (!known && !detail::isStandardColumn(column.field)) fields.push_back(column.field);
    }
  }
  return fields;
}

int pointFormatOf(const Strips& strips) {
  int format = 6;
  for (const StripWithColumns& strip : strips) {
    for (const PointColumn& column : strip.columns) {
      if (!detail::isStandardColumn(column.field)) continue;
      format = std::max(format, column.field.name == "nir" ? 8 : 7);
    }
  }
  return format;
}

LasWriterOptions optionsFor(const Strips& strips, const std::vector<std::uint16_t>& numbers) {
  Eigen::Vector3d minimum = Eigen::Vector3d::Constant(HUGE_VAL);
  double earliest = HUGE_VAL, latest = -HUGE_VAL;
  for (const StripWithColumns& strip : strips) {
    for (const PointLidar& point : *strip.cloud) {
      const Eigen::Vector3d ground = strip.frame.toGround(point.getVector3fMap());
      if (ground.allFinite()) minimum = minimum.cwiseMin(ground);
      earliest = std::min(earliest, point.gps_time);
      latest = std::max(latest, point.gps_time);
    }
  }
  if (!minimum.allFinite()) minimum.setZero();
  LasWriterOptions options =
      newLasOptions(strips.front().frame.crs, probableTimeKind(earliest, latest), minimum);
  options.point_format = pointFormatOf(strips);
  options.extra_fields = extraFieldsOf(strips);
  if (strips.size() == 1) options.file_source_id = numbers.front();
  const auto corrected =
      std::find_if(strips.begin(), strips.end(),
                   [](const StripWithColumns& strip) { return !strip.corrections.empty(); });
  if (corrected != strips.end()) options.vlrs.push_back(lasCorrectionsVlr(corrected->corrections));
  return options;
}

PointChunk chunkOf(const StripWithColumns& strip, std::uint16_t number, std::size_t first,
                   std::size_t count) {
  PointChunk chunk;
  chunk.resize(count);
  for (std::size_t row = 0; row < count; ++row) {
    const PointLidar& point = (*strip.cloud)[first + row];
    const Eigen::Vector3d ground = strip.frame.toGround(point.getVector3fMap());
    chunk.x[row] = ground.x(), chunk.y[row] = ground.y(), chunk.z[row] = ground.z();
    chunk.gps_time[row] = point.gps_time;
    chunk.intensity[row] = point.intensity;
    chunk.scan_angle[row] = point.scan_angle;
    chunk.point_source_id[row] = number != 0 ? number : point.point_source_id;
    chunk.return_number[row] = point.return_number;
    chunk.number_of_returns[row] = point.number_of_returns;
    chunk.classification[row] = point.classification;
    chunk.flags[row] = point.flags;
    chunk.user_data[row] = point.user_data;
    chunk.channel[row] = point.flags >> 6U;
  }
  return chunk;
}

/// Writes points as records with their columns.
class StripRecords {
 public:
  StripRecords(const fs::path& path, const LasWriterOptions& options)
      : name_(path.string()), writer_(path, options), fields_(writer_.extraFields()) {
    for (LasExtraField& field : detail::standardColumns(writer_.layout())) {
      fields_.push_back(std::move(field));
    }
    const Eigen::Vector3d metres = writer_.units().metres();
    scale_ = writer_.header().scale.cwiseProduct(metres);
    offset_ = writer_.header().offset.cwiseProduct(metres);
  }

  void append(const StripWithColumns& strip, std::uint16_t number) {
    for (std::size_t first = 0; first < strip.cloud->size(); first += PointReader::kChunk) {
      const std::size_t count = std::min(PointReader::kChunk, strip.cloud->size() - first);
      const std::size_t length = writer_.header().record_length;
      buffer_.assign(count * length, std::byte{0});
      encodeLasRecords(chunkOf(strip, number, first, count), length, writer_.layout(), scale_,
                       offset_, writer_.pointCount(), name_, buffer_.data());
      for (const PointColumn& column : strip.columns) {
        const auto from = column.values.begin() + static_cast<std::ptrdiff_t>(first);
        encodeLasExtraField({from, from + static_cast<std::ptrdiff_t>(count)}, length,
                            fieldNamed(column.field.name), name_, buffer_.data());
      }
      writer_.appendRecords(buffer_.data(), count);
    }
  }
  void finish() { writer_.finish(); }

 private:
  const LasExtraField& fieldNamed(const std::string& name) const {
    return *std::find_if(fields_.begin(), fields_.end(),
                         [&](const LasExtraField& field) { return field.name == name; });
  }

  std::string name_;
  LasWriter writer_;
  std::vector<LasExtraField> fields_;  ///< extra bytes, then standard fields, with positions
  Eigen::Vector3d scale_, offset_;     ///< metres
  std::vector<std::byte> buffer_;
};

void saveLas(const fs::path& path, const Strips& strips) {
  std::vector<std::uint16_t> numbers;
  for (const StripWithColumns& strip : strips) numbers.push_back(numberOf(strip));
  checkNumbers(path.string(), strips, numbers);
  StripRecords records(path, optionsFor(strips, numbers));
  for (std::size_t s = 0; s < strips.size(); ++s) records.append(strips[s], numbers[s]);
  records.finish();
}

PcdColumn pcdColumn(const std::string& name, const PointColumn& column) {
  const LasExtraField& field = column.field;
  const bool exact = field.scale == 1.0 && field.offset == 0.0 && field.type != LasExtraType::f64;
  PcdColumn result{field.name, {}};
  std::replace(result.name.begin(), result.name.end(), ' ', '_');  // spaces separate names there
  result.values.reserve(column.values.size());
  for (const double value : column.values) {
    result.values.push_back(static_cast<float>(value));
    if (exact && std::isfinite(value) && static_cast<double>(result.values.back()) != value)
      throw UsageError(name + ": a PCD would round column " + field.name +
                       " to 32-bit floats; write LAS");
  }
  return result;
}

void saveStripAsPcd(const fs::path& path, const Strips& strips) {
  if (strips.size() != 1)
    throw UsageError(path.string() + ": a PCD holds one strip; " + std::to_string(strips.size()) +
                     " are given");
  std::vector<PcdColumn> columns;
  for (const PointColumn& column : strips.front().columns)
    columns.push_back(pcdColumn(path.string(), column));
  savePcd(path, strips.front(), columns);
}

}  // namespace

void saveStrips(const fs::path& path, const Strips& strips) {
  const std::string extension = lowerExtension(path);
  if (extension != ".las" && extension != ".laz" && extension != ".pcd")
    throw UsageError(path.string() + ": is neither .las, .laz nor .pcd");
  if (extension == ".laz" && lowerExtension(path.stem()) == ".copc")
    throw UsageError(path.string() + ": would not be COPC; choose another name");
  checkStrips(path.string(), strips);
  if (extension == ".pcd")
    saveStripAsPcd(path, strips);
  else
    saveLas(path, strips);
}

}  // namespace pcl_als
