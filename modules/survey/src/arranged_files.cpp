// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <memory>
#include <numeric>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/survey/arranged_files.h>

namespace pcl_als {
namespace {

std::vector<SurveyedFile> surveyAll(const std::vector<std::filesystem::path>& paths,
                                    const PointWindow& window) {
  requirePointFiles(paths.size());
  std::vector<SurveyedFile> files;
  files.reserve(paths.size());
  for (const std::filesystem::path& path : paths)
    files.push_back(surveyFile(SurveyInput::ofFile(path, window)));
  return files;
}

}  // namespace

CensusStrips censusStrips(const StripArrangement& arrangement, std::vector<std::uint64_t>& counts) {
  std::vector<StripArrangement::Sorter> sorters;
  for (std::size_t file = 0; file < arrangement.fileCount(); ++file)
    sorters.emplace_back(arrangement, file);
  counts.assign(arrangement.labels().size(), 0);
  CensusStrips strips;
  strips.names = arrangement.names();
  strips.run = [&arrangement, &counts, sorters](std::size_t file, const PointChunk& chunk,
                                                std::size_t from) mutable {
    const auto [to, label] = sorters[file].run(chunk, from);
    counts[label] += to - from;
    return std::pair(to, arrangement.labels()[label].index);
  };
  return strips;
}

ArrangedFiles::ArrangedFiles(const std::vector<std::filesystem::path>& paths,
                             const StripChoice& choice, const PointWindow& window)
    : window_(window),
      files_(surveyAll(paths, window)),
      arrangement_(files_, choice, FlownTimes()) {
  const bool any = std::any_of(files_.begin(), files_.end(), [](const SurveyedFile& file) {
    return file.sources.info.point_count > 0;
  });
  if (!any && !window.everything()) refuseEmptyWindow(paths, window);
  if (arrangement_.names().empty())
    throw InputError("no strip is left: all are excluded or have no times");
}

std::uint64_t ArrangedFiles::Use::pointCount() const {
  return std::accumulate(points.begin(), points.end(), std::uint64_t{0});
}

Eigen::AlignedBox3d ArrangedFiles::Use::box() const {
  Eigen::AlignedBox3d all;
  for (const Eigen::AlignedBox3d& box : boxes) all.extend(box);
  return all;
}

ArrangedFiles::Use ArrangedFiles::use() const {
  Use use;
  use.points.resize(arrangement_.names().size());
  use.boxes.resize(arrangement_.names().size());
  std::vector<std::uint64_t> counts;
  const CensusStrips strips = censusStrips(arrangement_, counts);
  PointChunk chunk;
  for (std::size_t file = 0; file < files_.size(); ++file) {
    const auto reader = PointReader::open(files_[file].sources.info.path, window_);
    while (reader->read(chunk)) {
      for (std::size_t from = 0; from < chunk.size();) {
        const auto [to, strip] = strips.run(file, chunk, from);
        if (strip >= 0) {
          use.points[static_cast<std::size_t>(strip)] += to - from;
          Eigen::AlignedBox3d& box = use.boxes[static_cast<std::size_t>(strip)];
          for (std::size_t i = from; i < to; ++i)
            box.extend(Eigen::Vector3d(chunk.x[i], chunk.y[i], chunk.z[i]));
        }
        from = to;
      }
    }
  }
  use.left_out = arrangement_.leftOut(counts);
  return use;
}

SurveyCensus takeCensus(const std::vector<std::filesystem::path>& files, double cell,
                        const std::function<void(double)>& progress, const StripChoice& choice,
                        const PointWindow& window, std::vector<LeftOutPoints>& left_out) {
  const ArrangedFiles arranged(files, choice, window);
  std::vector<std::uint64_t> counts;
  std::vector<PointFileInfo> measured;
  for (const SurveyedFile& file : arranged.files()) measured.push_back(file.sources.info);
  SurveyCensus census = takeCensus(files, cell > 0.0 ? cell : usualCensusCell(measured), progress,
                                   censusStrips(arranged.arrangement(), counts), window);
  left_out = arranged.arrangement().leftOut(counts);
  return census;
}

}  // namespace pcl_als
