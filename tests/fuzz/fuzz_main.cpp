// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdlib>
#include <string_view>

#include <pcl_als/common/thread_limit.h>

#include "fuzz_targets.h"

namespace {

/// On one thread: inputs of some hundred bytes are handed to others more slowly than they are read.
const pcl_als::fuzz::Target& target() {
  pcl_als::limitThreads(1);
  for (const auto& each : pcl_als::fuzz::PCL_ALS_FUZZ_TARGETS())
    if (std::string_view(PCL_ALS_FUZZ_TARGET) == each.name) return each;
  std::abort();
}

}  // namespace

// libFuzzer's entry; the build names the target and the function that lists it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const pcl_als::fuzz::Target& fuzzed = target();
  fuzzed.run(data, size);
  return 0;
}
