// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// What the processes of a DeliveryChecker tell each other.
#include <set>
#include <tuple>

#include <pcl_als/common/parallel.h>
#include <pcl_als/processing/delivery_checker.h>

#include "delivery_messages.h"

namespace pcl_als {
namespace {

/// Applies a function to all numbers of an alignment, for writing and for reading.
template <typename Alignment, typename Function>
void forNumbers(Alignment& result, const Function& each) {
  each(result.status), each(result.motion), each(result.covariance);
  each(result.covariance_formal), each(result.covariance_jackknife);
  each(result.jackknife_groups), each(result.covariance_correlated), each(result.surface_std);
  each(result.convergence_std), each(result.deformation_std), each(result.scale_std);
  each(result.sigma0), each(result.redundancy), each(result.pairs), each(result.source_points);
  each(result.iterations), each(result.coarse_iterations), each(result.overlap_area);
  each(result.radius), each(result.normal_before), each(result.normal_after);
  each(result.vertical_before), each(result.vertical_after), each(result.vertical_pairs);
}

void put(ByteWriter& out, const PatchAlignmentResult& result) {
  forNumbers(result, [&out](const auto& value) { out.plain(value); });
  out.put(result.message);
  for (const auto& parameter : result.parameters)
    out.put(parameter.determined).put(parameter.reason);
}

void get(ByteReader& in, PatchAlignmentResult& result) {
  forNumbers(result, [&in](auto& value) { in.plain(value); });
  in.get(result.message);
  for (auto& parameter : result.parameters) in.get(parameter.determined).get(parameter.reason);
}

}  // namespace

namespace detail {

void shareDifferences(Communicator* processes, const SharedItems& items,
                      std::vector<std::vector<ControlDifference>>& differences) {
  shareValues(
      processes, items, differences,
      [](ByteWriter& out, const std::vector<ControlDifference>& found) {
        out.put(found.size());
        for (const ControlDifference& d : found) {
          out.put(d.point).put(d.strip).put(d.position).put(d.above).put(d.slope);
          out.put(d.roughness).put(d.unfit).put(d.normal).put(d.slope_std);
        }
      },
      [](ByteReader& in, std::vector<ControlDifference>& found) {
        found.resize(in.take<std::size_t>());
        for (ControlDifference& d : found) {
          in.get(d.point).get(d.strip).get(d.position).get(d.above).get(d.slope);
          in.get(d.roughness).get(d.unfit).get(d.normal).get(d.slope_std);
        }
      });
}

void shareAlignments(Communicator* processes, const SharedItems& items,
                     std::vector<CheckedPair>& pairs) {
  shareValues(
      processes, items, pairs,
      [](ByteWriter& out, const CheckedPair& pair) {
        out.put(pair.milliseconds).put(pair.alignment.has_value());
        if (pair.alignment) put(out, *pair.alignment);
      },
      [](ByteReader& in, CheckedPair& pair) {
        if (in.get(pair.milliseconds).take<bool>()) get(in, pair.alignment.emplace());
      });
}

}  // namespace detail

void DeliveryChecker::shareStrips() {
  strip_shares_ = survey_.stripShares();
  if (!areShared(survey_.processes())) return;
  std::vector<std::string> strips(courses_.size());
  for (const std::size_t index : strip_shares_.ownItems()) {
    const int strip = static_cast<int>(index);
    ByteWriter out;
    map_.putStrip(strip, out);
    courses_[index].put(out);
    if (plausibility_) plausibility_->putStrip(strip, out);
    strips[index] = out.take();
  }
  shareBytes(survey_.processes(), strip_shares_, strips);
  for (std::size_t index = 0; index < strips.size(); ++index) {
    if (strip_shares_.mine(index)) continue;
    const int strip = static_cast<int>(index);
    ByteReader in(strips[index]);
    map_.getStrip(strip, in);
    courses_[index].get(in);
    if (plausibility_) plausibility_->getStrip(strip, in);
  }
}

void DeliveryChecker::shareAreas() {
  Communicator* const processes = survey_.processes();
  const std::size_t targets = offsets_.size() + control_offsets_.size();
  std::vector<double> points(targets);
  for (std::size_t i = 0; i < targets; ++i) points[i] = static_cast<double>(target(i).pointCount());
  if (areShared(processes)) {
    std::uint64_t uncovered = 0;
    const ByteWriter own = ByteWriter().put(uncovered_.load()).put(points);
    std::fill(points.begin(), points.end(), 0.0);
    for (const std::string& bytes : processes->gatherAll(own.bytes())) {
      ByteReader in(bytes);
      uncovered += in.take<std::uint64_t>();
      const auto theirs = in.take<std::vector<double>>();
      for (std::size_t i = 0; i < targets; ++i) points[i] += theirs[i];
    }
    uncovered_ = uncovered;
  }
  loaded_points_ = 0;
  for (const double count : points) loaded_points_ += static_cast<std::size_t>(count);
  target_shares_ = SharedItems(processes, points);
  if (!areShared(processes)) return;
  std::vector<ByteWriter> sent(static_cast<std::size_t>(processes->size()));
  for (std::size_t i = 0; i < targets; ++i) {
    if (target_shares_.mine(i)) continue;
    ByteWriter& out = sent[static_cast<std::size_t>(target_shares_.owner(i))];
    for (const std::size_t strip : strip_shares_.ownItems()) {
      if (target(i).points(static_cast<int>(strip)).empty()) continue;
      out.put(i).put(strip);
      target(i).put(static_cast<int>(strip), out);
    }
    target(i).clear();
  }
  receivePoints(sent);
}

void DeliveryChecker::receivePoints(std::vector<ByteWriter>& sent) {
  std::vector<std::string> bytes;
  for (ByteWriter& out : sent) bytes.push_back(out.take());
  for (const std::string& received : survey_.processes()->exchange(bytes)) {
    for (ByteReader in(received); !in.done();) {
      const auto i = in.take<std::size_t>();
      target(i).get(static_cast<int>(in.take<std::size_t>()), in);
    }
  }
}

void DeliveryChecker::forOwn(std::size_t first, std::size_t count,
                             const std::function<void(std::size_t i)>& work) const {
  std::vector<std::size_t> own;
  for (const std::size_t i : target_shares_.ownItems())
    if (i >= first && i < first + count) own.push_back(i);
  doTogether(survey_.processes(), [&] {
    parallelFor(own.size(), settings_.threads, [&](std::size_t i) { work(own[i]); });
  });
}

void DeliveryChecker::shareMeasurements(std::vector<std::vector<double>>& repeated) {
  if (!areShared(survey_.processes())) return;
  std::vector<std::string> areas(target_shares_.count());
  for (const std::size_t i : target_shares_.ownItems()) {
    if (i >= areas_.size()) continue;
    ByteWriter out;
    out.put(counts_[i]).put(repeated[i]).put(milliseconds_[i]);
    for (const std::vector<OffsetSample>& samples : samples_[i]) out.putPlain(samples);
    areas[i] = out.take();
  }
  shareBytes(survey_.processes(), target_shares_, areas);
  for (std::size_t i = 0; i < areas_.size(); ++i) {
    if (target_shares_.mine(i)) continue;
    ByteReader in(areas[i]);
    in.get(counts_[i]).get(repeated[i]).get(milliseconds_[i]);
    for (std::vector<OffsetSample>& samples : samples_[i]) in.getPlain(samples);
    areas[i] = {};
  }
}

void DeliveryChecker::sharePairPoints(const std::vector<CheckedPair>& pairs,
                                      const SharedItems& shares) {
  Communicator* const processes = survey_.processes();
  if (!areShared(processes)) return;
  std::vector<ByteWriter> sent(static_cast<std::size_t>(processes->size()));
  std::set<std::tuple<int, std::size_t, int>> known;  // receiver, area, strip
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [a, b] = overlaps_[k].strips;
    const int to = shares.owner(k);
    if (!isAligned(pairs[k]) || to == processes->rank()) continue;
    for (std::size_t i = 0; i < areas_.size(); ++i) {
      if (!target_shares_.mine(i)) continue;
      if (offsets_[i].points(a).empty() || offsets_[i].points(b).empty()) continue;
      for (const int strip : {a, b}) {
        if (!known.emplace(to, i, strip).second) continue;
        ByteWriter& out = sent[static_cast<std::size_t>(to)];
        out.put(i).put(static_cast<std::size_t>(strip));
        offsets_[i].put(strip, out);
      }
    }
  }
  receivePoints(sent);
}

}  // namespace pcl_als
