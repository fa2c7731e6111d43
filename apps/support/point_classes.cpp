// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "point_classes.h"

#include <atomic>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/las_file.h>
#include <pcl_als/io/las_rewriter.h>
#include <pcl_als/io/pcd_io.h>

namespace pcl_als::app {
namespace {

// Formats 0-5 keep flags in the upper three bits.
constexpr unsigned kShortClass = 0x1F;

PointClassCounts classifyPcd(const std::filesystem::path& input,
                             const std::filesystem::path& output,
                             const std::shared_ptr<const PointClassifier>& classifier) {
  Strip<PointLidar> strip = loadPcd(input);
  LandCoverFilter<PointLidar> filter;
  filter.setClassifier(classifier);
  filter.setLocalFrame(strip.frame);
  filter.setInputCloud(strip.cloud);
  const pcl::PointCloud<PointLidar>::Ptr classified(new pcl::PointCloud<PointLidar>);
  filter.filter(*classified);
  strip.cloud = classified;
  savePcd(output, strip);
  return {classified->size(), filter.getUnclassified()};
}

}  // namespace

PointClassCounts classifyPointFile(const std::filesystem::path& input,
                                   const std::filesystem::path& output,
                                   const std::shared_ptr<const PointClassifier>& classifier,
                                   int threads) {
  if (input.extension() == ".pcd") return classifyPcd(input, output, classifier);
  const LasFile file(input);
  const LasHeader& header = file.header();
  const LasRecordLayout& layout = file.layout();
  std::vector<std::uint8_t> codes;
  for (const GaussianClass& c : classifier->model().classes) codes.push_back(asprsCodeOf(c.name));
  std::atomic<std::uint64_t> unclassified{0};
  const LasEdit edit = [&](const LasRecordBlock& block) {
    std::uint64_t missed = 0;
    for (std::size_t i = 0; i < block.count; ++i) {
      std::byte* record = block.records + i * block.record_length;
      double place[3];
      for (int axis = 0; axis < 3; ++axis)
        place[axis] =
            loadLas<std::int32_t>(record + 4 * axis) * header.scale[axis] + header.offset[axis];
      const auto decision =
          classifier->classify(place[0], place[1], place[2], loadLas<std::uint16_t>(record + 12));
      if (decision.index == MaximumLikelihood::kNoClass) {
        ++missed;
        continue;
      }
      const unsigned code = codes[static_cast<std::size_t>(decision.index)];
      std::byte* field = record + layout.classification;
      const unsigned flags =
          layout.extended ? 0U : std::to_integer<unsigned>(*field) & ~kShortClass;
      *field = static_cast<std::byte>(flags | code);
    }
    unclassified += missed;
  };
  const std::uint64_t points = rewriteLas(file, output, edit, threads).points;
  return {points, unclassified.load()};
}

}  // namespace pcl_als::app
