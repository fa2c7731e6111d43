// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/listed_names.h>
#include <pcl_als/survey/strip_assignment.h>

namespace pcl_als {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double justAfter(double time) {
  return std::nextafter(time, kInfinity);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Times at which the trajectory's coverage changes, in order, and what holds from each on.
std::vector<std::pair<double, std::optional<ExclusionReason>>> coverageOf(
    const Trajectory& flight) {
  std::vector<std::pair<double, std::optional<ExclusionReason>>> spans;
  spans.emplace_back(-kInfinity, ExclusionReason::before_trajectory);
  spans.emplace_back(flight.startTime(), std::nullopt);
  for (const Trajectory::Gap& gap : flight.gaps()) {
    spans.emplace_back(justAfter(gap.from), ExclusionReason::in_trajectory_gap);
    spans.emplace_back(gap.to, std::nullopt);
  }
  spans.emplace_back(justAfter(flight.endTime()), ExclusionReason::after_trajectory);
  return spans;
}

}  // namespace

std::size_t stripNamed(const std::vector<std::string>& strips, const std::string& name,
                       const std::string& option) {
  const auto found = std::find(strips.begin(), strips.end(), name);
  if (found != strips.end()) return static_cast<std::size_t>(found - strips.begin());
  std::string all;
  for (const std::string& strip : strips) all += (all.empty() ? "" : ", ") + strip;
  throw UsageError("option -" + option + ": there is no strip '" + name + "'; there are " + all);
}

std::vector<bool> chosenStrips(const StripChoice& choice, const std::vector<std::string>& strips) {
  std::vector<bool> chosen(strips.size(), choice.only.empty());
  const auto mark = [&](const std::vector<std::string>& names, const char* option, bool value) {
    for (const std::string& name : names) chosen[stripNamed(strips, name, option)] = value;
  };
  mark(choice.only, "strips", true);
  mark(choice.without, "without", false);
  return chosen;
}

/// Points of a strip: of these ids, from one time (aligned) until another.
struct StripAssignment::Piece {
  std::string name;
  std::vector<Key> keys;
  std::string whole;      ///< the strip that it is a line of
  bool is_given = false;  ///< the name is that of an input
  double from = -kInfinity, until = kInfinity;
  std::optional<ExclusionReason> between;  ///< lines: why it is none
};

StripAssignment::StripAssignment(const std::vector<SurveyedFile>& files, const StripChoice& choice,
                                 const FlownTimes& flown)
    : files_(files), flown_(flown) {
  if (flown_.alignments.empty() && flown_.trajectory == nullptr)
    flown_.alignments = continuousTimes(files);
  flown_.alignments.resize(files.size());
  const std::vector<Piece> all = pieces(choice);
  checkNames(choice, all);
  for (const Piece& piece : all) arrange(piece, choice);
}

SwathTrack StripAssignment::trackOf(const std::vector<Key>& keys) const {
  SwathTrack track;
  for (const auto& [file, id] : keys)
    track.merge(files_[file].tracks.at(id), flown_.alignments[file]);
  return track;
}

/// \param strip its number or name; "0": lines have no strip
void StripAssignment::addLines(const std::string& strip, const std::vector<TimeStretch>& stretches,
                               const std::vector<Key>& keys, std::vector<Piece>& found) {
  const auto lines = std::count_if(stretches.begin(), stretches.end(),
                                   [](const TimeStretch& stretch) { return stretch.isLine(); });
  const bool nameless = strip == "0";
  int line = 0;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    Piece piece;
    piece.keys = keys;
    piece.whole = strip;
    piece.between = stretches[i].excluded;
    if (piece.between) {
      const bool hovering = piece.between == ExclusionReason::hovering;
      piece.name = (nameless ? "" : strip + ".") + (hovering ? "hovering" : "turns");
    } else {
      const std::string place = std::to_string(++line);
      piece.name = nameless ? "line" + place : lines == 1 ? strip : strip + "." + place;
    }
    if (i > 0) piece.from = stretches[i].from;
    if (i + 1 < stretches.size()) piece.until = stretches[i + 1].from;
    found.push_back(std::move(piece));
  }
}

/// Adds the lines of a strip that is certainly several of them.
bool StripAssignment::divide(const Piece& strip, std::vector<Piece>& found) {
  const SwathTrack track = trackOf(strip.keys);
  if (track.empty()) return false;
  const std::vector<TimeStretch> stretches = splitTrack(track, flown_.trajectory);
  if (!leadBack(track, stretches)) return false;
  const std::size_t first = found.size();
  addLines(strip.name, stretches, strip.keys, found);
  std::vector<std::string> names;
  for (std::size_t i = first; i < found.size(); ++i)
    if (!found[i].between) names.push_back(found[i].name);
  divisions_.push_back("strip " + strip.name + " holds " + std::to_string(names.size()) +
                       " flight lines, which lead back and forth, and is divided into " +
                       listedNames(names));
  return true;
}

std::vector<StripAssignment::Piece> StripAssignment::pieces(const StripChoice& choice) {
  std::vector<PointFileSources> sources;
  for (const SurveyedFile& file : files_) sources.push_back(file.sources);
  const StripNaming naming(sources);
  std::vector<Piece> named, found;
  std::map<std::uint16_t, std::vector<Key>> pools;
  std::map<std::string, std::size_t> place;
  for (std::size_t file = 0; file < files_.size(); ++file) {
    for (const PointSource& source : sources[file].sources) {
      const std::string& given = files_[file].strip;
      if (choice.split && source.hasTimes() && given.empty()) {
        pools[source.id].emplace_back(file, source.id);
        continue;
      }
      const std::string& name = given.empty() ? naming.nameOf(file, source.id) : given;
      const auto [known, added] = place.try_emplace(name, named.size());
      if (added) {
        named.emplace_back();
        named.back().name = named.back().whole = name;
        named.back().is_given = !given.empty();
      }
      named[known->second].keys.emplace_back(file, source.id);
    }
  }
  for (const Piece& strip : named)
    if (!choice.divide_lines || choice.split || strip.is_given || !divide(strip, found))
      found.push_back(strip);
  for (const auto& [id, keys] : pools)
    addLines(std::to_string(id), splitTrack(trackOf(keys), flown_.trajectory), keys, found);
  return found;
}

void StripAssignment::checkNames(const StripChoice& choice, const std::vector<Piece>& all) {
  std::vector<std::string> strips;
  for (const Piece& piece : all) {
    if (piece.between) continue;
    strips.push_back(piece.name);
    if (choice.divide_lines && !contains(strips, piece.whole)) strips.push_back(piece.whole);
  }
  for (const std::string& name : choice.only) stripNamed(strips, name, "strips");
  for (const std::string& name : choice.without) stripNamed(strips, name, "without");
}

bool StripAssignment::areOfOnePass(std::size_t a, std::size_t b) const {
  const std::vector<std::int64_t>&one = seconds_[a], &other = seconds_[b];
  std::vector<std::int64_t> common;
  std::set_intersection(one.begin(), one.end(), other.begin(), other.end(),
                        std::back_inserter(common));
  return !common.empty() && 2 * common.size() >= std::min(one.size(), other.size());
}

std::size_t StripAssignment::labelFor(const std::string& strip,
                                      std::optional<ExclusionReason> reason) {
  Label label{strip, -1, reason.value_or(ExclusionReason::excluded)};
  if (!reason) {
    const auto found = std::find(names_.begin(), names_.end(), strip);
    label.index = static_cast<int>(found - names_.begin());
    if (found == names_.end()) {
      names_.push_back(strip);
      expected_.push_back(0);
      seconds_.emplace_back();
    }
  }
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    if (labels_[i].strip == strip && labels_[i].index == label.index &&
        labels_[i].reason == label.reason)
      return i;
  }
  labels_.push_back(label);
  return labels_.size() - 1;
}

/// Points with times, in bins of the track.
double StripAssignment::coveredShare(const Piece& piece, std::uint64_t& covered) const {
  std::uint64_t all = 0;
  covered = 0;
  const SwathTrack track = trackOf(piece.keys);
  for (const auto& entry : track.bins()) {
    const SwathTrack::Bin& bin = entry.second;
    if (bin.first < piece.from || bin.first >= piece.until) continue;
    all += bin.points;
    const bool inside = !flown_.needed || flown_.trajectory == nullptr ||
                        flown_.trajectory->coverage(bin.middle()) == Trajectory::Coverage::covered;
    if (inside) covered += bin.points;
  }
  return all == 0 ? 1.0 : static_cast<double>(covered) / static_cast<double>(all);
}

void StripAssignment::addCoverage(Table& table, const Piece& piece) {
  const std::size_t used = labelFor(piece.name, std::nullopt);
  if (flown_.trajectory == nullptr || !flown_.needed) {
    table.from.emplace_back(piece.from, used);
    return;
  }
  const auto spans = coverageOf(*flown_.trajectory);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double end = i + 1 < spans.size() ? spans[i + 1].first : kInfinity;
    if (end <= piece.from || spans[i].first >= piece.until) continue;
    table.from.emplace_back(std::max(spans[i].first, piece.from),
                            spans[i].second ? labelFor(piece.name, spans[i].second) : used);
  }
}

/// Points of time 0 among others have lost theirs; a file without any time is of another kind.
bool StripAssignment::losesTimeless(const Key& key, const StripChoice& choice) const {
  if (flown_.trajectory != nullptr && flown_.needed) return true;
  if (choice.keep_timeless && !choice.split) return false;
  const auto& sources = files_[key.first].sources.sources;
  return std::any_of(sources.begin(), sources.end(),
                     [](const PointSource& source) { return source.hasTimes(); });
}

/// The reason for which a part is excluded as a whole, if any, and its number of covered points.
std::optional<ExclusionReason> StripAssignment::exclusionReason(const Piece& piece,
                                                                const StripChoice& choice,
                                                                std::uint64_t& covered) const {
  const double share = coveredShare(piece, covered);
  if (piece.between) return piece.between;
  const auto names = [&piece, &choice](const std::vector<std::string>& list) {
    return contains(list, piece.name) || (choice.divide_lines && contains(list, piece.whole));
  };
  if ((!choice.only.empty() && !names(choice.only)) || names(choice.without))
    return ExclusionReason::excluded;
  const bool timeless = std::all_of(piece.keys.begin(), piece.keys.end(), [&](const Key& key) {
    return losesTimeless(key, choice) && files_[key.first].tracks.at(key.second).empty();
  });
  if (timeless) return ExclusionReason::zero_time;
  if (share < kLeastCovered) return ExclusionReason::strip_uncovered;
  return std::nullopt;
}

void StripAssignment::arrange(const Piece& piece, const StripChoice& choice) {
  std::uint64_t covered = 0;
  const std::optional<ExclusionReason> whole = exclusionReason(piece, choice, covered);
  for (const Key& key : piece.keys) {
    Table& table = tables_[key];
    const bool loses = losesTimeless(key, choice);
    if (loses && !table.zero_time)
      table.zero_time = labelFor(piece.name, whole ? *whole : ExclusionReason::zero_time);
    if (whole)
      table.from.emplace_back(piece.from, labelFor(piece.name, whole));
    else
      addCoverage(table, piece);
    for (const PointSource& source : files_[key.first].sources.sources)
      if (source.id == key.second && !loses) covered += source.without_time;
  }
  if (whole) return;
  const std::size_t strip = stripNamed(names_, piece.name, "");
  expected_[strip] += covered;
  const SwathTrack track = trackOf(piece.keys);
  std::vector<std::int64_t>& seconds = seconds_[strip];
  for (const auto& entry : track.bins()) {
    const SwathTrack::Bin& bin = entry.second;
    if (bin.first < piece.from || bin.first >= piece.until) continue;
    const auto second = static_cast<std::int64_t>(std::floor(bin.middle()));
    if (seconds.empty() || seconds.back() != second) seconds.push_back(second);
  }
}

std::vector<int> StripAssignment::stripsOf(std::size_t file, std::uint16_t id) const {
  std::vector<int> strips;
  for (const auto& entry : tables_.at({file, id}).from) {
    const int index = labels_[entry.second].index;
    if (index >= 0 && std::find(strips.begin(), strips.end(), index) == strips.end())
      strips.push_back(index);
  }
  return strips;
}

std::vector<ExcludedPoints> StripAssignment::excludedPoints(
    const std::vector<std::uint64_t>& points_of_label) const {
  std::map<std::string, std::uint64_t> all;
  for (std::size_t i = 0; i < labels_.size(); ++i) all[labels_[i].strip] += points_of_label[i];
  std::vector<ExcludedPoints> parts;
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const Label& label = labels_[i];
    if (label.index >= 0 || points_of_label[i] == 0) continue;
    parts.push_back({label.strip, label.reason, points_of_label[i], all[label.strip]});
  }
  return parts;
}

StripAssignment::Assigner::Assigner(const StripAssignment& arrangement, std::size_t file)
    : arrangement_(arrangement), file_(file), alignment_(arrangement.flown_.alignments[file]) {}

std::size_t StripAssignment::Assigner::label(std::uint16_t id, double time) {
  if (table_ == nullptr || id != id_) {
    const auto found = arrangement_.tables_.find({file_, id});
    if (found == arrangement_.tables_.end())
      throw InputError(arrangement_.files_[file_].sources.info.path.string() +
                       ": was changed while it was read");
    table_ = &found->second;
    id_ = id;
    from_ = until_ = 0.0;
  }
  if (time == 0.0 && table_->zero_time) return *table_->zero_time;
  const double aligned = alignment_(time);
  if (aligned >= from_ && aligned < until_) return label_;
  const auto& from = table_->from;
  auto next = std::upper_bound(from.begin(), from.end(), aligned,
                               [](double value, const std::pair<double, std::size_t>& entry) {
                                 return value < entry.first;
                               });
  if (next == from.begin() || !std::isfinite(aligned)) next = from.begin() + 1;
  label_ = (next - 1)->second;
  if (!std::isfinite(aligned)) {
    from_ = until_ = 0.0;
    return label_;
  }
  from_ = (next - 1)->first;
  until_ = next == from.end() ? kInfinity : next->first;
  return label_;
}

std::pair<std::size_t, std::size_t> StripAssignment::Assigner::run(const PointChunk& chunk,
                                                                   std::size_t from) {
  const std::size_t first = label(chunk.point_source_id[from], chunk.gps_time[from]);
  std::size_t to = from + 1;
  while (to < chunk.size() && label(chunk.point_source_id[to], chunk.gps_time[to]) == first) ++to;
  return {to, first};
}

}  // namespace pcl_als
