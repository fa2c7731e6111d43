// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <vector>

#include <pcl_als/las/las_sample.h>

namespace pcl_als {

void samplePoints(const LasFile& file, SampleSize size,
                  const std::function<void(const PointChunk&)>& visit) {
  const LasHeader& header = file.header();
  const LasScaling metres = file.toMetres();
  const std::uint64_t all = header.point_count;
  if (all == 0 || size.runs == 0 || size.points_per_run == 0) return;
  if (header.compressed && size.runs > size.most_places) {
    size.points_per_run = size.points_per_run * size.runs / size.most_places;
    size.runs = size.most_places;
  }
  const bool whole = all <= static_cast<std::uint64_t>(size.runs) * size.points_per_run;
  const std::uint64_t runs =
      whole ? (all + size.points_per_run - 1) / size.points_per_run : size.runs;
  std::vector<std::byte> records(size.points_per_run * header.record_length);
  PointChunk chunk;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const std::uint64_t length = std::min<std::uint64_t>(size.points_per_run, all);
    const std::uint64_t first = whole       ? run * length
                                : runs == 1 ? 0
                                            : (all - length) / (runs - 1) * run;
    const std::uint64_t count = std::min(length, all - first);
    file.readRecords(first, count, records.data());
    decodeLasRecords(records.data(), count, header.record_length, file.layout(), metres.scale,
                     metres.offset, chunk);
    visit(chunk);
  }
}

}  // namespace pcl_als
