// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The pairs of a DeliveryChecker: their assessment, and what is said of those that were not
// measured.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/processing/delivery_checker.h>
#include <pcl_als/quality/strip_alignment.h>
#include <pcl_als/registration/patch_alignment.h>
#include <pcl_als/survey/survey_map.h>

#include "delivery_messages.h"

namespace pcl_als {
namespace {

// Points that ICPatch uses of each strip of a pair: sufficient for its standard deviations, seconds
// for a pair.
constexpr std::size_t kAlignmentPoints = 400'000, kAlignmentPairs = 60'000;
// NMAD of differences over their limit: those of different objects fill the range (0.74).
constexpr double kScattered = 0.25;
constexpr double kBytesPerPoint = sizeof(LidarReturn) + 73.0;  // including its part of the TIN
constexpr std::size_t kNamedPairs = 5;                         // pairs in a sentence

using detail::Clock;
using detail::millisecondsSince;

/// At most \a most, evenly.
std::vector<OffsetSample> thinned(std::vector<OffsetSample> samples, std::size_t most) {
  if (samples.size() <= most) return samples;
  std::vector<OffsetSample> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(samples[i * samples.size() / most]);
  return some;
}

std::string pairName(const CheckedPair& pair) {
  return pair.a + " and " + pair.b;
}

std::string withDistance(const CheckedPair& pair) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", std::abs(pair.assessment.apart));
  return pairName(pair) + " (" + text + ")";
}

std::string withReason(const CheckedPair& pair) {
  return pairName(pair) + " (" + pair.assessment.reason + ")";
}

bool isMeasured(const CheckedPair& pair) {
  return pair.assessment.status == PairAssessment::Status::judged;
}
bool isTooFar(const CheckedPair& pair) {
  return pair.assessment.status == PairAssessment::Status::too_far;
}

}  // namespace

PairCounts countPairs(const std::vector<CheckedPair>& pairs) {
  PairCounts counts;
  for (const CheckedPair& pair : pairs) {
    std::size_t& kind = isMeasured(pair) && pair.of_one_pass ? counts.of_one_pass
                        : isMeasured(pair)                   ? counts.measured
                        : isTooFar(pair)                     ? counts.too_far
                        : pair.too_small                     ? counts.too_small
                                                             : counts.unmeasurable;
    ++kind;
  }
  return counts;
}

std::vector<std::string> unmeasuredPairs(const std::vector<CheckedPair>& pairs) {
  std::vector<std::string> far, without, of_one_pass;
  for (const CheckedPair& pair : pairs) {
    if (isMeasured(pair) && pair.of_one_pass) of_one_pass.push_back(pairName(pair));
    if (isTooFar(pair))
      far.push_back(withDistance(pair));
    else if (!isMeasured(pair) && !pair.too_small)
      without.push_back(withReason(pair));
  }
  std::vector<std::string> sentences;
  if (!far.empty())
    sentences.push_back(
        counted(far.size(), "overlapping pair") + (far.size() == 1 ? " lies" : " lie") +
        " too far apart in height to be compared: strips " + listedNames(far, kNamedPairs));
  if (!without.empty())
    sentences.push_back(counted(without.size(), "overlapping pair") +
                        " could not be measured: strips " + listedNames(without, kNamedPairs));
  if (!of_one_pass.empty())
    sentences.push_back(counted(of_one_pass.size(), "pair") +
                        " measured in one pass, whose errors both strips share, not counted: "
                        "strips " +
                        listedNames(of_one_pass, kNamedPairs));
  return sentences;
}

/// Names strips that are further apart than surfaces are compared. What was measured all the same
/// is of different objects, whose differences fill the range that is compared.
void DeliveryChecker::findDistance(std::size_t overlap, CheckedPair& pair) {
  const double limit = settings_.limits.maximum_distance;
  const SurveyMap::HeightOffset height = map_.heightOffset(overlaps_[overlap].strips);
  if (!(std::abs(height.offset) > limit)) return;
  PairAssessment& found = pair.assessment;
  const std::string text =
      describe(height, pair.a, pair.b) +
      ", further than surfaces are compared: a height offset of one strip (unit or vertical "
      "datum of its heights, trajectory)";
  warnings_.push_back(
      {"strips " + pair.a + " and " + pair.b + " overlap, but " + text, Hint::max_distance});
  const bool scattered = found.vertical.nmad > kScattered * limit;
  if (found.status == PairAssessment::Status::copy ||
      (found.status == PairAssessment::Status::judged && !scattered))
    return;
  found.status = PairAssessment::Status::too_far;
  found.quality_level.reset();
  found.apart = height.offset;
  found.reason += (found.reason.empty() ? "" : "; ") + text;
}

CheckedPair DeliveryChecker::assessOverlap(std::size_t k, CellMeans& cells) {
  const Clock::time_point start = Clock::now();
  const auto& [a, b] = overlaps_[k].strips;
  CheckedPair pair;
  pair.a = survey_.strips()[a];
  pair.b = survey_.strips()[b];
  pair.overlap_area = overlaps_[k].area;
  pair.too_small = pair.overlap_area < settings_.minimum_overlap;
  std::vector<OffsetSample> samples;
  for (std::size_t i = 0; i < areas_.size(); ++i) {
    const auto& found = samples_[i][k];
    samples.insert(samples.end(), found.begin(), found.end());
    samples_[i][k] = {};
    pair.milliseconds += milliseconds_[i][k];
    const std::size_t of_a = counts_[i][static_cast<std::size_t>(a)],
                      of_b = counts_[i][static_cast<std::size_t>(b)];
    if (of_a == 0 || of_b == 0) continue;
    ++pair.areas;
    pair.points_a += of_a;
    pair.points_b += of_b;
  }
  pair.assessment = assessPair(samples, courses_[static_cast<std::size_t>(a)].direction(),
                               courses_[static_cast<std::size_t>(b)].direction());
  pair.of_one_pass = survey_.areOfOnePass(a, b);
  findDistance(k, pair);
  cells = cellMeans(samples);
  pair.samples = thinned(std::move(samples), CheckedPair::kScatter);
  pair.memory_mb = 1e-6 * kBytesPerPoint * static_cast<double>(pair.points_a + pair.points_b);
  pair.milliseconds += millisecondsSince(start);
  return pair;
}

void DeliveryChecker::registerPairs(std::vector<CheckedPair>& pairs,
                                    const std::function<void(double)>& progress) {
  PatchAlignmentSettings settings;
  settings.points = kAlignmentPoints;
  settings.pairs = kAlignmentPairs;
  settings.resolution = survey_.resolution();
  settings.threads = settings_.threads;
  std::vector<double> costs;
  for (const CheckedPair& pair : pairs)
    costs.push_back(isAligned(pair) ? static_cast<double>(pair.points_a + pair.points_b) : 0.0);
  const SharedItems shares(survey_.processes(), costs);
  sharePairPoints(pairs, shares);
  doTogether(survey_.processes(), [&] {
    std::size_t done = 0;
    for (const std::size_t k : shares.ownItems()) {
      const Clock::time_point start = Clock::now();
      const auto& [a, b] = overlaps_[k].strips;
      if (isAligned(pairs[k])) pairs[k].alignment = registerStrips(offsets_, a, b, settings);
      pairs[k].milliseconds += millisecondsSince(start);
      ++done;
      if (progress)
        progress(static_cast<double>(done) / static_cast<double>(shares.ownItems().size()));
    }
  });
  detail::shareAlignments(survey_.processes(), shares, pairs);
}

}  // namespace pcl_als
