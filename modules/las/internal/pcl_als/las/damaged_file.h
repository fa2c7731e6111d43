// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/errors.h>

namespace pcl_als {

/// A LAS or LAZ file is damaged or cut off behind its header: with LasDamage::keep_intact
/// the rest can be read.
class DamagedFile : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace pcl_als
