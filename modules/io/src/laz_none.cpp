// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>

#include "laz.h"

// Chosen by the build where LASzip was not found.
namespace pcl_als::detail {
namespace {

[[noreturn]] void refuse(const std::string& name) {
  throw InputError(name +
                   ": is LASzip-compressed and this build has no LASzip: install LASzip "
                   "(https://laszip.org) and build again with -DLASZIP_ROOT=<its prefix>, or "
                   "convert the file to .las");
}

}  // namespace

bool lazSupported() {
  return false;
}

std::unique_ptr<LazReader> openLazReader(const std::string&, const LasHeader&,
                                         const std::string& name) {
  refuse(name);
}

std::unique_ptr<LazWriter> makeLazWriter(const LasHeader&, const std::string& name) {
  refuse(name);
}

}  // namespace pcl_als::detail
