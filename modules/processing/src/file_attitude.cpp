// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "file_attitude.h"

#include <algorithm>
#include <vector>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_file.h>

namespace pcl_als::detail {
namespace {

std::shared_ptr<const Trajectory> levelled(std::shared_ptr<const Trajectory> flight) {
  if (!flight->hasAttitude()) return flight;
  return std::make_shared<const Trajectory>(flight->withoutAttitude());
}

/// Hands out runs of 32 points in every 512 of an uncompressed file: enough of every scan line to
/// see the attitude by, without decoding all of them.
template <typename Visit>
void visitSome(const LasFile& file, const Visit& visit) {
  constexpr std::uint64_t kEvery = 512, kRun = 32;
  const LasHeader& header = file.header();
  const LasScaling metres = file.toMetres();
  const std::size_t length = header.record_length;
  std::vector<std::byte> records(kRun * length);
  for (std::uint64_t first = 0; first < header.point_count; first += kEvery) {
    const std::uint64_t size = std::min(kRun, header.point_count - first);
    file.readRecords(first, size, records.data());
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::byte* record = &records[i * length];
      visit(file.layout().timeOf(record),
            LasRecordLayout::positionOf(record, metres.scale, metres.offset));
    }
  }
}

/// The same of a compressed one, which has to be unpacked from its start.
template <typename Visit>
void visitSome(PointReader& reader, const Visit& visit) {
  constexpr std::size_t kEvery = 16;
  PointChunk chunk;
  while (reader.read(chunk)) {
    for (std::size_t i = 0; i < chunk.size(); i += kEvery) {
      visit(chunk.gps_time[i], Eigen::Vector3d(chunk.x[i], chunk.y[i], chunk.z[i]));
    }
  }
}

}  // namespace

AttitudeRecovery::Outcome recoveredAttitude(const LasFile& file, const TimeAlignment& alignment,
                                            std::shared_ptr<const Trajectory> flight) {
  AttitudeRecovery recovery(levelled(std::move(flight)));
  const auto add = [&](double time, const Eigen::Vector3d& point) {
    recovery.add(alignment(time), point);
  };
  if (file.header().compressed) {
    visitSome(*PointReader::open(file.path()), add);
  } else {
    visitSome(file, add);
  }
  return recovery.recover();
}

AttitudeRecovery::Outcome recoveredAttitude(const Strip<PointLidar>& strip,
                                            const TimeAlignment& alignment,
                                            std::shared_ptr<const Trajectory> flight) {
  AttitudeRecovery recovery(levelled(std::move(flight)));
  for (const PointLidar& point : *strip.cloud) {
    recovery.add(alignment(point.gps_time),
                 strip.frame.origin + point.getVector3fMap().cast<double>());
  }
  return recovery.recover();
}

}  // namespace pcl_als::detail
