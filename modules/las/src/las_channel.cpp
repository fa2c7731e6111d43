// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/las/las_channel.h>
#include <pcl_als/las/las_compatibility.h>

#include "las_bytes.h"

namespace pcl_als {
namespace {

constexpr const char* kUserData = "user_data";

bool isScannerChannel(const std::string& field) {
  return field.empty() || field == "scanner_channel";
}

}  // namespace

LasChannel::LasChannel(const LasFile& file, const std::string& field)
    : file_(file.path().string()) {
  if (field == kUserData) {
    position_ = static_cast<std::size_t>(file.layout().user_data);
    mask_ = 0xFF;
  } else if (!isScannerChannel(field)) {
    takeExtraField(file, field);
  } else if (file.layout().extended) {
    position_ = 15;
    shift_ = 4;
    mask_ = 3;
  } else if (const auto compatibility = LasCompatibility::of(file)) {
    position_ = compatibility->flagsPosition();
    shift_ = 1;
    mask_ = 3;
  }
}

void LasChannel::takeExtraField(const LasFile& file, const std::string& field) {
  const LasExtraField* found = findLasExtraField(file.extraFields(), field, file_);
  if (found == nullptr) {
    std::string names = kUserData;
    for (const LasExtraField& known : file.extraFields()) names += ", " + known.name;
    throw InputError(file_ + ": has no field '" + field +
                     "' with the channel of the scanner; it has " + names);
  }
  if (found->type == LasExtraType::undocumented)
    throw InputError(file_ + ": field '" + field +
                     "' with the channel of the scanner has no data type");
  field_ = *found;
}

void LasChannel::decode(const std::byte* records, std::size_t count, std::size_t record_length,
                        std::uint8_t* channels) const {
  if (!field_) {
    for (std::size_t i = 0; i < count; ++i)
      channels[i] = static_cast<std::uint8_t>(
          detail::byteAt(records + i * record_length + position_) >> shift_ & mask_);
    return;
  }
  std::vector<double> values;
  decodeLasExtraField(records, count, record_length, *field_, values);
  const std::string where = file_ + ": field '" + field_->name + "'";
  for (std::size_t i = 0; i < count; ++i) channels[i] = channelOfValue(values[i], where);
}

unsigned LasChannel::lazFields(const std::string& field) {
  if (isScannerChannel(field)) return 0;
  return field == kUserData ? kLazUserData : kLazExtraBytes;
}

}  // namespace pcl_als
