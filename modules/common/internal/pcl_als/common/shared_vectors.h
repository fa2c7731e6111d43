// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/shared_work.h>

namespace pcl_als {

/// Collective: shareValues() of vectors whose elements consist of numbers and matrices of fixed
/// size only.
template <typename T>
void shareVectors(Communicator* processes, const SharedItems& items,
                  std::vector<std::vector<T>>& vectors) {
  shareValues(
      processes, items, vectors,
      [](ByteWriter& out, const std::vector<T>& vector) { out.putPlain(vector); },
      [](ByteReader& in, std::vector<T>& vector) { in.getPlain(vector); });
}

}  // namespace pcl_als
