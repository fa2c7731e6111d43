// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/strip_naming.h>

namespace pcl_als {
namespace {

using Files = std::vector<PointFileSources>;

bool sameSingleId(const Files& files) {
  if (files.size() < 2) return false;
  return std::all_of(files.begin(), files.end(), [&](const PointFileSources& file) {
    return file.sources.size() == 1 && files[0].sources.size() == 1 &&
           file.sources[0].id == files[0].sources[0].id;
  });
}

/// Times that follow each other, each file's beginning at most kLargestGap after the others' end.
bool timesConnect(const Files& files) {
  std::vector<std::pair<double, double>> ranges;
  for (const PointFileSources& file : files)
    ranges.emplace_back(file.sources[0].first_time, file.sources[0].last_time);
  std::sort(ranges.begin(), ranges.end());
  double end = ranges[0].second;
  for (const auto& [first, last] : ranges) {
    if (!(first <= end + StripNaming::kLargestGap)) return false;
    end = std::max(end, last);
  }
  return end > ranges[0].first;  // times that are all the same are no times
}

/// Names that files need for their own points; whatever is taken makes them longer.
std::string ownName(const std::filesystem::path& path, const std::set<std::string>& taken) {
  for (const std::string& name : {path.stem().string(), path.filename().string(), path.string()})
    if (taken.count(name) == 0) return name;
  int copy = 2;
  while (taken.count(path.string() + "#" + std::to_string(copy)) != 0) ++copy;
  return path.string() + "#" + std::to_string(copy);
}

}  // namespace

void PointSource::merge(const PointSource& other) {
  if (other.hasTimes()) {
    first_time = hasTimes() ? std::min(first_time, other.first_time) : other.first_time;
    last_time = hasTimes() ? std::max(last_time, other.last_time) : other.last_time;
  }
  points += other.points;
  without_time += other.without_time;
  minimum = minimum.cwiseMin(other.minimum);
  maximum = maximum.cwiseMax(other.maximum);
}

Eigen::AlignedBox3d PointFileSources::box() const {
  Eigen::AlignedBox3d box;
  for (const PointSource& source : sources) {
    if (!source.minimum.allFinite() || !source.maximum.allFinite()) continue;
    box.extend(source.minimum);
    box.extend(source.maximum);
  }
  return box;
}

StripNaming::StripNaming(const Files& files) {
  const bool by_file = sameSingleId(files) && !timesConnect(files);
  std::set<std::string> taken;
  for (const PointFileSources& file : files)
    for (const PointSource& source : file.sources)
      if (source.id != 0 && !by_file) taken.insert(std::to_string(source.id));
  for (std::size_t f = 0; f < files.size(); ++f)
    for (const PointSource& source : files[f].sources) {
      const bool own = source.id == 0 || by_file;
      const std::string name = own ? ownName(files[f].info.path, taken) : std::to_string(source.id);
      if (own) taken.insert(name);
      strips_[{f, source.id}] = name;
      if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
    }
}

const std::string& StripNaming::nameOf(std::size_t file, std::uint16_t id) const {
  const auto found = strips_.find({file, id});
  if (found != strips_.end()) return found->second;
  throw UsageError("file " + std::to_string(file) + " has no points of source id " +
                   std::to_string(id));
}

PointFileSources surveySources(const std::filesystem::path& path,
                               const std::function<void(const PointChunk&)>& also) {
  return surveySources(*PointReader::open(path), also);
}

namespace {

/// The points of a chunk from one row to another, which have the same id.
PointSource sourceOf(const PointChunk& chunk, std::size_t from, std::size_t to) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PointSource source{chunk.point_source_id[from], to - from};
  double first = kInfinity, last = -kInfinity;
  for (std::size_t i = from; i < to; ++i) {
    const double time = chunk.gps_time[i];
    const bool timed = std::isfinite(time) && time != 0.0;
    source.without_time += timed ? 0 : 1;
    first = std::min(first, timed ? time : kInfinity);
    last = std::max(last, timed ? time : -kInfinity);
  }
  if (source.hasTimes()) source.first_time = first, source.last_time = last;
  const std::vector<double>* const columns[] = {&chunk.x, &chunk.y, &chunk.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double* const values = columns[axis]->data();
    double least = kInfinity, most = -kInfinity;
    for (std::size_t i = from; i < to; ++i) {
      least = std::min(least, values[i]);
      most = std::max(most, values[i]);
    }
    source.minimum[axis] = least, source.maximum[axis] = most;
  }
  return source;
}

}  // namespace

PointFileSources surveySources(PointReader& reader,
                               const std::function<void(const PointChunk&)>& also) {
  PointFileSources file{reader.info(), {}, reader.damage(), {}};
  file.info.point_count = 0;  // of a part of a file only an estimate is known before
  std::map<std::uint16_t, PointSource> sources;
  PointChunk chunk;
  while (reader.read(chunk)) {
    file.info.point_count += chunk.size();
    for (std::size_t from = 0, to = 0; from < chunk.size(); from = to) {
      const std::uint16_t id = chunk.point_source_id[from];
      for (to = from + 1; to < chunk.size() && chunk.point_source_id[to] == id; ++to) {
      }
      const PointSource run = sourceOf(chunk, from, to);
      const auto [found, added] = sources.try_emplace(id, run);
      if (!added) found->second.merge(run);
    }
    if (also) also(chunk);
  }
  for (const auto& entry : sources) file.sources.push_back(entry.second);
  const Eigen::AlignedBox3d box = file.box();
  const std::string remark = reader.boxRemark(box);
  if (!remark.empty()) file.box_remark = file.info.path.string() + ": " + remark;
  if (!box.isEmpty()) file.info.minimum = box.min(), file.info.maximum = box.max();
  return file;
}

}  // namespace pcl_als
