// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The readings of SurveyReader.
#include <algorithm>
#include <mutex>
#include <numeric>

#include <pcl_als/common/header_box.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/survey/strip_assignment.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

SurveyReader::Visitor SurveyReader::asReturns(Sink sink) {
  return [sink = std::move(sink)](const Run& run) {
    thread_local std::vector<LidarReturn> points;
    run.points(points);
    sink(run.strip, points.data(), points.size());
  };
}

void SurveyReader::Run::points(std::vector<LidarReturn>& points) const {
  points.clear();
  points.reserve(to - from);
  for (std::size_t row = from; row < to; ++row) points.push_back(point(row));
}

std::set<int> SurveyReader::stripsIn(std::size_t file) const {
  if (!arrangement_) return {static_cast<int>(file)};
  std::set<int> strips;
  for (const PointSource& source : files()[file].sources.sources) {
    for (const int strip : arrangement_->stripsOf(file, source.id)) {
      if (channels_.empty()) strips.insert(strip);
      if (channels_.empty()) continue;
      for (const auto& channel : channels_[static_cast<std::size_t>(strip)])
        strips.insert(channel.second);
    }
  }
  return strips;
}

SurveyReader::Groups SurveyReader::groupsOfFiles() const {
  std::vector<std::size_t> group(files().size());
  std::iota(group.begin(), group.end(), 0);
  std::map<int, std::size_t> first_file;
  const auto join = [&](std::size_t file, int strip) {
    const auto [known, added] = first_file.try_emplace(strip, file);
    if (added || group[known->second] == group[file]) return;
    const std::size_t merged = group[file], into = group[known->second];
    std::replace(group.begin(), group.end(), merged, into);
  };
  for (std::size_t file = 0; file < files().size(); ++file)
    for (const int strip : stripsIn(file)) join(file, strip);
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t file = 0; file < files().size(); ++file) members[group[file]].push_back(file);
  Groups groups;
  groups.reserve(members.size());
  for (auto& entry : members) groups.push_back(std::move(entry.second));
  return groups;
}

std::vector<std::size_t> SurveyReader::filesOf(const Reading& reading) const {
  std::vector<std::size_t> chosen = reading.files;
  if (chosen.empty()) {
    chosen.resize(files().size());
    std::iota(chosen.begin(), chosen.end(), 0);
  }
  if (reading.strip < 0) return chosen;
  const auto lacks = [&](std::size_t file) { return stripsIn(file).count(reading.strip) == 0; };
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(), lacks), chosen.end());
  return chosen;
}

SurveyReader::Groups SurveyReader::groupsOf(const Reading& reading,
                                            bool one_after_the_other) const {
  const std::vector<std::size_t> chosen = filesOf(reading);
  if (one_after_the_other) return {chosen};
  const std::set<std::size_t> wanted(chosen.begin(), chosen.end());
  Groups groups = groupsOfFiles();
  for (std::vector<std::size_t>& group : groups) {
    const auto is_excluded = [&](std::size_t file) { return wanted.count(file) == 0; };
    group.erase(std::remove_if(group.begin(), group.end(), is_excluded), group.end());
  }
  return groups;
}

SharedItems SurveyReader::sharesOf(const Groups& groups, Communicator* processes) const {
  std::vector<double> costs;
  for (const std::vector<std::size_t>& group : groups) {
    costs.push_back(0.0);
    for (const std::size_t file : group)
      costs.back() += static_cast<double>(files()[file].sources.info.point_count);
  }
  return {processes, costs};
}

SharedItems SurveyReader::stripShares() const {
  const Groups groups = groupsOfFiles();
  const SharedItems shares = sharesOf(groups, processes_);
  std::vector<int> owners(strips_.size(), 0);
  for (std::size_t group = 0; group < groups.size(); ++group)
    for (const std::size_t file : groups[group])
      for (const int strip : stripsIn(file))
        owners[static_cast<std::size_t>(strip)] = shares.owner(group);
  return {processes_, owners};
}

std::vector<ExcludedPoints> SurveyReader::read(const Visitor& visit, const Reading& reading) const {
  using Share = Reading::Share;
  if (reading.share == Share::first && areShared(processes_)) return readByFirst(visit, reading);
  Communicator* const together = reading.share == Share::all ? nullptr : processes_;
  const int threads = reading.threads.value_or(threads_);
  const Groups groups = groupsOf(reading, threads == 1 && !areShared(together));
  const std::size_t labels = arrangement_ ? arrangement_->labels().size() : 1;
  std::vector<LabelCounts> counts(groups.size(), LabelCounts(labels));
  const SharedItems shares = sharesOf(groups, together);
  doTogether(together, [&] { readGroups(groups, shares.ownItems(), visit, reading, counts); });
  shareValues(
      together, shares, counts, [](ByteWriter& out, const LabelCounts& count) { out.put(count); },
      [](ByteReader& in, LabelCounts& count) { in.get(count); });
  LabelCounts all(labels);
  for (const LabelCounts& count : counts)
    for (std::size_t i = 0; i < labels; ++i) all[i] += count[i];
  return arrangement_ ? arrangement_->excludedPoints(all) : std::vector<ExcludedPoints>();
}

std::vector<ExcludedPoints> SurveyReader::readByFirst(const Visitor& visit, Reading reading) const {
  reading.share = Reading::Share::all;
  std::vector<ExcludedPoints> excluded;
  doTogether(processes_, [&] {
    if (isRoot(processes_)) excluded = read(visit, reading);
  });
  return excluded;
}

void SurveyReader::readGroups(const Groups& groups, const std::vector<std::size_t>& chosen,
                              const Visitor& visit, const Reading& reading,
                              std::vector<LabelCounts>& counts) const {
  std::uint64_t all = 0, read = 0;
  for (const std::size_t group : chosen)
    for (const std::size_t file : groups[group]) all += files()[file].sources.info.point_count;
  std::mutex reporting;
  const auto done = [&](std::size_t points) {
    if (!progress_) return;
    const std::lock_guard<std::mutex> lock(reporting);
    read += points;
    progress_(std::min(1.0, static_cast<double>(read) / static_cast<double>(all)));
  };
  parallelFor(chosen.size(), reading.threads.value_or(threads_), [&](std::size_t i) {
    for (const std::size_t file : groups[chosen[i]])
      readFile(file, visit, reading, done, counts[chosen[i]]);
  });
}

void SurveyReader::readFile(std::size_t file, const Visitor& visit, const Reading& reading,
                            const std::function<void(std::size_t points)>& done,
                            LabelCounts& counts) const {
  const auto reader = inputs_[file].open(reading.extra_field);
  PointChunk chunk;
  while (reader->read(chunk)) {
    for (std::size_t from = 0; from < chunk.size();) {
      const Run run = runAt(file, chunk, from);
      counts[run.label] += run.to - from;
      if (run.strip >= 0) passOn(run, visit, reading.strip);
      from = run.to;
    }
    done(chunk.size());
  }
}

SurveyReader::Run SurveyReader::runAt(std::size_t file, const PointChunk& chunk,
                                      std::size_t from) const {
  if (!arrangement_)
    return {static_cast<int>(file), 0, file, chunk, from, chunk.size(), times_[file]};
  const auto [to, label] = StripAssignment::Assigner(*arrangement_, file).run(chunk, from);
  return {arrangement_->labels()[label].index, label, file, chunk, from, to, times_[file]};
}

void SurveyReader::passOn(const Run& run, const Visitor& visit, int only) const {
  if (channels_.empty()) {
    if (only < 0 || run.strip == only) visit(run);
    return;
  }
  std::map<std::uint8_t, std::vector<std::size_t>> rows;
  for (std::size_t row = run.from; row < run.to; ++row) rows[run.chunk.channel[row]].push_back(row);
  for (const auto& [channel, chosen] : rows) {
    const int strip = channels_[static_cast<std::size_t>(run.strip)].at(channel);
    if (only >= 0 && strip != only) continue;
    const PointChunk part = run.chunk.select(chosen);
    visit({strip, run.label, run.file, part, 0, part.size(), run.time});
  }
}

std::uint64_t SurveyReader::Contents::pointCount() const {
  return std::accumulate(points.begin(), points.end(), std::uint64_t{0});
}

Eigen::AlignedBox3d SurveyReader::Contents::box() const {
  Eigen::AlignedBox3d all;
  for (const Eigen::AlignedBox3d& box : boxes) all.extend(box);
  return all;
}

SurveyReader::Contents SurveyReader::measure() const {
  Contents contents;
  contents.points.resize(strips_.size());
  contents.boxes.resize(strips_.size());
  contents.excluded = read([&contents](const Run& run) {
    const auto strip = static_cast<std::size_t>(run.strip);
    contents.points[strip] += run.to - run.from;
    contents.boxes[strip].extend(boxOf(run.chunk, run.from, run.to));
  });
  return contents;
}

}  // namespace pcl_als
