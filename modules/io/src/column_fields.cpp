// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "column_fields.h"

#include <algorithm>

namespace pcl_als::detail {
namespace {

LasExtraField standardField(const char* name, LasExtraType type, int position) {
  LasExtraField field;
  field.name = name;
  field.type = type;
  field.position = static_cast<std::size_t>(position);
  field.size = lasExtraSize(field);
  return field;
}

}  // namespace

std::vector<LasExtraField> standardColumns(const LasRecordLayout& layout) {
  std::vector<LasExtraField> fields;
  if (layout.rgb >= 0) {
    fields.push_back(standardField("red", LasExtraType::u16, layout.rgb));
    fields.push_back(standardField("green", LasExtraType::u16, layout.rgb + 2));
    fields.push_back(standardField("blue", LasExtraType::u16, layout.rgb + 4));
  }
  if (layout.nir >= 0) fields.push_back(standardField("nir", LasExtraType::u16, layout.nir));
  return fields;
}

bool isStandardColumn(const LasExtraField& field) {
  // Point format 8 has all of them.
  const std::vector<LasExtraField> all = standardColumns(LasRecordLayout::of(8));
  return field.scale == 1.0 && field.offset == 0.0 &&
         std::any_of(all.begin(), all.end(), [&](const LasExtraField& each) {
           return each.name == field.name && each.type == field.type;
         });
}

}  // namespace pcl_als::detail
