// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "fuzz_targets.h"

// libFuzzer's entry; the build names the target.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const pcl_als::fuzz::Target& target = pcl_als::fuzz::targetNamed(PCL_ALS_FUZZ_TARGET);
  target.run(data, size);
  return 0;
}
