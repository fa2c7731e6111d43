// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>

namespace pcl_als {

Error::Error(const std::string& message, Hint hint)
    : std::runtime_error(printable(message)), remedy_(hint) {}

}  // namespace pcl_als
