// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "column_reader.h"

#include <algorithm>
#include <utility>

#include <pcl_als/common/file_extension.h>

namespace pcl_als::detail {
namespace {

/// All fields of a file besides those of PointLidar; arrays as one field for each value.
std::vector<LasExtraField> columnsOf(const LasFile& file) {
  std::vector<LasExtraField> fields = standardColumns(file.layout());
  for (LasExtraField field : file.extraFields()) {
    if (field.type == LasExtraType::undocumented) continue;
    const std::string name = field.name;
    const int count = std::exchange(field.components, 1);
    field.size = lasExtraSize(field);
    for (int i = 0; i < count; ++i) {
      if (count > 1) field.name = name + "[" + std::to_string(i) + "]";
      fields.push_back(field);
      field.position += field.size;
    }
  }
  return fields;
}

}  // namespace

ColumnReader::ColumnReader(const std::filesystem::path& path, std::size_t file,
                           const StripLoading& loading)
    : file_(file) {
  const std::string extension = lowerExtension(path);
  const bool wanted = loading.all_columns || !loading.columns.empty();
  if (!wanted || (extension != ".las" && extension != ".laz")) {
    reader_ = PointReader::open(path, loading.window);
    return;
  }
  constexpr unsigned kFields =
      LasPointReader::kColumns | kLazColour | kLazInfrared | kLazUserData | kLazExtraBytes;
  auto las = std::make_unique<LasPointReader>(path, loading.window,
                                              PointReader::OtherCoordinates::refuse, kFields);
  las_ = las.get();
  reader_ = std::move(las);
  chooseFields(loading);
}

void ColumnReader::chooseFields(const StripLoading& loading) {
  for (const LasExtraField& field : columnsOf(las_->file())) {
    names_ += (names_.empty() ? "" : ", ") + field.name;
    const auto& wanted = loading.columns;
    if (loading.all_columns || std::find(wanted.begin(), wanted.end(), field.name) != wanted.end())
      fields_.push_back(field);
  }
  values_.resize(fields_.size());
}

bool ColumnReader::read(PointChunk& chunk) {
  if (!reader_->read(chunk)) return false;
  for (std::size_t k = 0; k < fields_.size(); ++k)
    decodeLasExtraField(las_->records(), chunk.size(), las_->file().header().record_length,
                        fields_[k], values_[k]);
  return true;
}

}  // namespace pcl_als::detail
