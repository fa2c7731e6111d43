// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/radiometry/intensity_statistics.h>

namespace pcl_als {
namespace {

constexpr std::uint32_t kEnd = 65536;  // of the counts of a histogram

}  // namespace

double varianceToMean(const RunningStatistics& statistics) {
  if (statistics.mean() <= 0.0) return 0.0;
  const double sigma = statistics.standardDeviation();
  return sigma * sigma / statistics.mean();
}

IntensityStatistics::IntensityStatistics(std::size_t strips) : strips_(strips), classes_(256) {}

void IntensityStatistics::add(std::size_t strip, double before, double after, double slope,
                              std::uint8_t classification) {
  std::size_t bin = kSlopeBins;
  if (!std::isnan(slope))
    bin = std::min(kSlopeBins - 1, static_cast<std::size_t>(slope / kSlopeStep));
  strips_[strip].all.add(before, after);
  strips_[strip].slopes[bin].add(before, after);
  classes_[classification].add(before, after);
}

void IntensityStatistics::merge(const IntensityStatistics& other) {
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    strips_[i].all.merge(other.strips_[i].all);
    for (std::size_t bin = 0; bin <= kSlopeBins; ++bin)
      strips_[i].slopes[bin].merge(other.strips_[i].slopes[bin]);
  }
  for (std::size_t code = 0; code < classes_.size(); ++code)
    classes_[code].merge(other.classes_[code]);
}

BeforeAfter IntensityStatistics::slope(std::size_t bin) const {
  BeforeAfter sum;
  for (const Strip& strip : strips_) sum.merge(strip.slopes[bin]);
  return sum;
}

BeforeAfter IntensityStatistics::all() const {
  BeforeAfter sum;
  for (const Strip& strip : strips_) sum.merge(strip.all);
  return sum;
}

void IntensityHistogram::put(ByteWriter& out) const {
  for (const std::vector<std::uint64_t>* values : {&before, &after}) {
    for (std::uint32_t value = 0; value < values->size(); ++value)
      if ((*values)[value] != 0) out.put(value).put((*values)[value]);
    out.put(kEnd);
  }
}

void IntensityHistogram::add(ByteReader& in) {
  for (std::vector<std::uint64_t>* values : {&before, &after}) {
    for (auto value = in.take<std::uint32_t>(); value != kEnd; in.get(value))
      values->at(value) += in.take<std::uint64_t>();
  }
}

void IntensityStatistics::put(ByteWriter& out) const {
  out.putPlain(strips_).putPlain(classes_);
}

void IntensityStatistics::get(ByteReader& in) {
  in.getPlain(strips_).getPlain(classes_);
}

}  // namespace pcl_als
