// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/pcd_writer.h>

#include "pcd_layout.h"
#include "point_fill.h"

namespace pcl_als {

struct PcdWriter::State {
  AtomicFile file;
  std::string name;
  detail::PcdDescription description;
  std::vector<char> block;

  explicit State(const std::filesystem::path& path) : file(path), name(path.string()) {}
};

PcdWriter::PcdWriter(const std::filesystem::path& path, LocalFrame frame, std::string strip_id,
                     std::string corrections)
    : state_(std::make_unique<State>(path)) {
  detail::PcdDescription& description = state_->description;
  description.strip_id = std::move(strip_id);
  description.frame = std::move(frame);
  description.corrections = std::move(corrections);
  description.counts_later = true;
  state_->file.write(detail::pcdHeaderText(description));
}

PcdWriter::~PcdWriter() = default;

void PcdWriter::append(const PointChunk& chunk, std::size_t from, std::size_t to) {
  State& s = *state_;
  const Eigen::Vector3d& origin = s.description.frame.origin;
  s.block.resize((to - from) * detail::kPcdRecord);
  for (std::size_t i = from; i < to; ++i) {
    const PointLidar point = detail::pointOf(chunk, i, origin);
    const double farthest = point.getVector3fMap().cwiseAbs().maxCoeff();
    if (!(farthest <= kFarthest))
      throw InputError(s.name +
                       ": a point lies more than 32 km from the centre of the file, where "
                       "the floats of a PCD have steps of more than 2 mm; write smaller parts");
    detail::putPcdPoint(point, &s.block[(i - from) * detail::kPcdRecord]);
  }
  s.file.write(s.block.data(), s.block.size());
  s.description.width += to - from;
}

std::uint64_t PcdWriter::pointCount() const {
  return state_->description.width;
}

void PcdWriter::finish() {
  const std::string header = detail::pcdHeaderText(state_->description);
  state_->file.writeAt(0, header.data(), header.size());
  state_->file.commit();
}

}  // namespace pcl_als
