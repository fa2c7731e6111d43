// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <string>

#include <pcl_als/common/distributions.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/registration/patch_alignment.h>
#include <pcl_als/registration/point_view.h>

#include "alignment_areas.h"
#include "alignment_report.h"
#include "cloud_overlap.h"
#include "patch_adjustment.h"
#include "update_history.h"

namespace pcl_als {
namespace {

using namespace registration;
using Eigen::Affine3d;
using Eigen::Vector3d;
using Status = PatchAlignmentResult::Status;

constexpr std::size_t kCoarsePoints = 20'000;
constexpr int kCoarseLevels = 3, kCoarseIterations = 15;
constexpr double kFirstFineThreshold = 3.0;  // metres, upper limit
constexpr double kLeastThreshold = 0.25;     // metres
constexpr double kThresholdSigmas = 8.0;
constexpr std::size_t kFewestPairs = 50;
constexpr double kSmallUpdate = 5e-3;  // metres: an update that ends a stage of the iteration
// The first stage uses a part of the candidates.
constexpr std::size_t kFirstStride = 4, kEnoughForStride = 40'000;
constexpr double kOscillation = 10.0;  // of updates, over the limit of convergence
constexpr std::size_t kSecondEstimatePairs = 25'000;
// This estimate contributes half of the variance of the difference, which is estimated from two
// values: the 95 % limit is that of Student's t with two degrees of freedom.
const double kTwoValues = studentCritical(0.025, 2.0) / normalCritical(0.025) / std::sqrt(2.0);
constexpr double kThresholdChange = 1e-3;  // metres: below, the threshold is no longer changed

void exchangeChoices(std::vector<AreaSurfaces>& areas) {
  for (AreaSurfaces& area : areas) {
    area.source.exchangeChoice();
    area.target.exchangeChoice();
  }
}

/// One alignment, step by step; the working coordinates are the target's about a reference point.
class Alignment {
 public:
  Alignment(const PatchAlignmentSettings& settings, const Affine3d& guess)
      : settings_(settings), guess_(guess), noise_{settings.source_noise, settings.target_noise} {}

  PatchAlignmentResult run(const PointView& source, const PointView& target);

 private:
  void registerCoarsely();
  void registerLevel(std::vector<AreaSurfaces>& level, double cell);
  std::vector<AreaSurfaces> prepareAreas(const WorkingPoints& source, const WorkingPoints& target);
  void chooseCandidates(std::vector<AreaSurfaces>& areas, const SurfaceCriterion& criterion,
                        std::size_t count) const;
  bool registerFinely(std::vector<AreaSurfaces>& areas);
  bool registerDetermined(std::vector<AreaSurfaces>& areas);
  void keepSwing(const Unknowns& update);
  void setMotion();
  void compareWithAllSurfaces(std::vector<AreaSurfaces>& areas);
  Unknowns returnToGuess() const;
  bool isSmall(const Unknowns& update) const;
  Unknowns adjust(const PatchPairs& pairs, double limit, double prior);
  AdjustmentFrame frame() const {
    return {motion_ * overlap_.centroid, overlap_.radius, settings_.estimate_scale};
  }
  PatchAlignmentResult fail(Status status, const std::string& message);

  const PatchAlignmentSettings& settings_;
  Affine3d guess_;
  PointNoise noise_;
  CloudOverlap overlap_;
  Affine3d motion_ = Affine3d::Identity();
  double threshold_ = 0.0;
  RobustWeight robust_ = kWhileMoving;
  Weighting weighting_;  ///< frozen, as the threshold is, when the updates no longer decrease
  SurfaceCriterion criterion_ = surfaceCriterion();
  PatchPairs pairs_;
  bool second_chosen_ = false;  ///< the candidates of the second estimate
  PatchAlignmentResult result_;
};

PatchAlignmentResult Alignment::fail(Status status, const std::string& message) {
  result_.status = status;
  result_.message = message;
  for (auto& parameter : result_.parameters) parameter.reason = message;
  return result_;
}

void Alignment::registerCoarsely() {
  threshold_ = settings_.search_distance;
  std::vector<CommonCells> levels{overlap_.cells.pooled()};
  while (levels.size() < kCoarseLevels) levels.push_back(levels.back().pooled());
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    std::vector<AreaSurfaces> areas(1);
    parallelFor(2, settings_.threads, [&](std::size_t i) {
      SurfaceSide& side = i == 0 ? areas[0].source : areas[0].target;
      side =
          SurfaceSide((i == 0 ? level->source : level->target).points(), {}, settings_.resolution);
      side.makeCoarse(kCoarsePoints);
    });
    registerLevel(areas, level->source.grid().cell);
  }
}

void Alignment::registerLevel(std::vector<AreaSurfaces>& level, double cell) {
  for (int i = 0; i < kCoarseIterations; ++i) {
    const PatchPairs pairs =
        findPairs(level, motion_, threshold_, overlap_.groups, noise_, settings_.threads);
    if (pairs.size() < kFewestPairs) return;
    // A prior of a few metres, because flat ground does not determine the motion in plan.
    const Unknowns update = adjust(pairs, 1e3, threshold_);
    motion_ = frame().motionOf(update) * motion_;
    threshold_ = std::clamp(kThresholdSigmas * weighting_.scatter.largest(), cell, threshold_);
    ++result_.coarse_iterations;
    if (update.norm() < 0.01 * cell) break;
  }
}

/// The update from the pairs.
Unknowns Alignment::adjust(const PatchPairs& pairs, double limit, double prior) {
  const AdjustmentFrame about = frame();
  return PatchAdjustment(pairs, about, robust_, settings_.threads).solve(limit, prior, weighting_);
}

std::vector<AreaSurfaces> Alignment::prepareAreas(const WorkingPoints& source,
                                                  const WorkingPoints& target) {
  const AlignmentAreas choice(overlap_.cells, settings_.points);
  std::vector<AreaSurfaces> areas = choice.triangulate(source, target, motion_, settings_);
  if (areas.empty()) return areas;
  const std::size_t samples = std::max<std::size_t>(30, 20'000 / areas.size());
  std::vector<std::vector<double>> roughness(2 * areas.size());
  parallelFor(roughness.size(), settings_.threads, [&](std::size_t i) {
    const AreaSurfaces& area = areas[i / 2];
    (i % 2 == 0 ? area.source : area.target).sampleRoughness(samples, roughness[i]);
  });
  std::vector<double> of_cloud[2];
  for (std::size_t i = 0; i < roughness.size(); ++i)
    of_cloud[i % 2].insert(of_cloud[i % 2].end(), roughness[i].begin(), roughness[i].end());
  for (std::vector<double>& values : of_cloud)
    if (!values.empty())
      criterion_.plain_roughness = std::max(criterion_.plain_roughness, medianInPlace(values));
  criterion_.roughness = std::clamp(3.0 * criterion_.plain_roughness, 0.005, criterion_.roughness);
  chooseCandidates(areas, criterion_, settings_.pairs);
  return areas;
}

void Alignment::chooseCandidates(std::vector<AreaSurfaces>& areas,
                                 const SurfaceCriterion& criterion, std::size_t count) const {
  const std::size_t of_area = std::max<std::size_t>(1, count / areas.size());
  parallelFor(2 * areas.size(), settings_.threads, [&](std::size_t i) {
    AreaSurfaces& area = areas[i / 2];
    (i % 2 == 0 ? area.source : area.target).chooseCandidates(of_area, criterion);
  });
}

/// Second estimate from all surfaces, almost without down-weighting: the part of its difference
/// that exceeds chance.
void Alignment::compareWithAllSurfaces(std::vector<AreaSurfaces>& areas) {
  constexpr int kIterations = 8;
  const Affine3d motion = motion_;
  SurfaceCriterion all = criterion_;
  all.roughness = 20.0 * criterion_.plain_roughness;
  all.edge_factor = 8.0;
  all.slope = 1.45;
  exchangeChoices(areas);
  if (!second_chosen_)
    chooseCandidates(areas, all, std::min(settings_.pairs, kSecondEstimatePairs));
  second_chosen_ = true;
  robust_ = kTrusting;
  weighting_.frozen = false;
  PatchPairs pairs;
  for (int i = 0; i < kIterations; ++i) {
    pairs = findPairs(areas, motion_, threshold_, overlap_.groups, noise_, settings_.threads);
    const Unknowns update = adjust(pairs, settings_.determined_std / 3.0, kNoPrior);
    motion_ = frame().motionOf(update) * motion_;
    if (update.norm() < 1e-4) break;
  }
  const AdjustmentFrame about = frame();
  const UnknownsMatrix chance =
      jackknife(PatchAdjustment(pairs, about, robust_, settings_.threads)
                    .accumulateGroups(weighting_.scatter, overlap_.groups.size()),
                weighting_.directions);
  exchangeChoices(areas);
  const RigidMotion there = RigidMotion::about(overlap_.centroid, motion_);
  motion_ = motion;
  const RigidMotion here = RigidMotion::about(overlap_.centroid, motion_);
  Eigen::Matrix<double, 6, 1> excess;
  for (int p = 0; p < PatchAlignmentResult::kParameters; ++p) {
    const double scale = p < 3 ? 1.0 : 1.0 / overlap_.radius;
    const double difference =
        p < 3 ? (there.shift - here.shift)[p] : (there.rotation - here.rotation)[p - 3];
    excess[p] = std::max(0.0, difference * difference - scale * scale * chance(p, p));
  }
  // The same in all directions in plan, because the difference is not related to an axis.
  excess.segment<2>(0).setConstant(kTwoValues * kTwoValues * excess.segment<2>(0).mean());
  excess.segment<2>(3).setConstant(excess.segment<2>(3).mean());
  result_.surface_std = excess.cwiseSqrt();
}

/** Three stages, each of which ends when updates are small or no longer become smaller: a part of
 * the candidates, all of them, and all without outliers. No stage is entered again: stages that
 * take turns have different solutions and would never converge. In the last one a stalled iteration
 * is damped, with its weights held.
 */
bool Alignment::registerFinely(std::vector<AreaSurfaces>& areas) {
  threshold_ = std::clamp(threshold_, kLeastThreshold, kFirstFineThreshold);
  double step = 1.0;
  bool last = false;
  std::size_t stride = settings_.pairs < kEnoughForStride ? 1 : kFirstStride;
  UpdateHistory history;
  robust_ = kWhileMoving;
  weighting_.frozen = false;
  for (int i = 0; i < settings_.maximum_iterations; ++i) {
    ++result_.iterations;
    pairs_ =
        findPairs(areas, motion_, threshold_, overlap_.groups, noise_, settings_.threads, stride);
    if (pairs_.size() < kFewestPairs * stride) {
      if (stride == 1) return false;
      stride = 1;
      continue;
    }
    const Unknowns update =
        adjust(pairs_, settings_.determined_std / 3.0, kNoPrior) + returnToGuess();
    const double moved = update.norm();
    const bool stalled = history.stalled(moved);
    if (last && stalled) {
      weighting_.frozen = true;
      step *= 0.5;
    }
    motion_ = frame().motionOf(step * update) * motion_;
    if (last && step * moved < settings_.convergence && isSmall(update)) {
      if (weighting_.frozen) keepSwing(update);
      return true;
    }
    if (!last && (stalled || moved < kSmallUpdate)) {
      last = stride == 1;
      stride = 1;
      if (last) robust_ = RobustWeight();
      history = UpdateHistory();
    }
    if (moved > kThresholdChange && !weighting_.frozen)
      threshold_ =
          std::clamp(kThresholdSigmas * weighting_.scatter.largest(), kLeastThreshold, threshold_);
  }
  return false;
}

/** Directions whose standard deviation, with the errors that neighbouring points share, exceeds the
 * limit keep their initial value from then on, and the others are estimated again: the pairs alone
 * seem to determine a motion in plan from the noise of flat ground. \return whether there are
 * pairs.
 */
bool Alignment::registerDetermined(std::vector<AreaSurfaces>& areas) {
  for (;;) {
    const bool converged = registerFinely(areas);
    if (pairs_.size() < kFewestPairs) return false;
    setMotion();
    AlignmentReport report(pairs_, frame(), weighting_.scatter, weighting_.directions, settings_);
    if (converged) compareWithAllSurfaces(areas);
    report.estimate(overlap_.groups, result_);
    result_.status = converged ? Status::converged : Status::not_converged;
    const HeldDirections more = report.undetermined();
    if (!converged || more.vectors.empty()) {
      report.fill(result_);
      return true;
    }
    weighting_.held.vectors.insert(weighting_.held.vectors.end(), more.vectors.begin(),
                                   more.vectors.end());
    weighting_.held.std.insert(weighting_.held.std.end(), more.std.begin(), more.std.end());
    result_.convergence_std.setZero();
  }
}

void Alignment::setMotion() {
  const Affine3d about_reference(Eigen::Translation3d(-overlap_.reference));
  result_.motion =
      RigidMotion::about(guess_.inverse() * (overlap_.centroid + overlap_.reference),
                         about_reference.inverse() * motion_ * about_reference * guess_);
}

/// The remaining update where the iteration was damped, which limits the accuracy of the motion.
void Alignment::keepSwing(const Unknowns& update) {
  result_.convergence_std << update.head<3>().cwiseAbs(),
      update.segment<3>(3).cwiseAbs() / overlap_.radius;
}

/// Reverts the movements of the coarse stage in directions that are not determined.
Unknowns Alignment::returnToGuess() const {
  const double scale = std::cbrt(motion_.linear().determinant());
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(motion_.linear() / scale));
  Unknowns total;
  total << motion_ * overlap_.centroid - overlap_.centroid,
      turn.angle() * overlap_.radius * turn.axis(), 0.0;
  const auto weak = weighting_.directions.vectors.leftCols(weighting_.directions.weak);
  return -(weak * (weak.transpose() * total));
}

/// Whether an update is far below the uncertainty of the estimate.
bool Alignment::isSmall(const Unknowns& update) const {
  const Unknowns parts = weighting_.directions.vectors.transpose() * update;
  return parts.cwiseAbs2().dot(weighting_.directions.values) < kOscillation * kOscillation;
}

PatchAlignmentResult Alignment::run(const PointView& source, const PointView& target) {
  if (!overlap_.find(source, target, settings_, guess_))
    return fail(Status::no_overlap, "the clouds do not overlap in plan");
  registerCoarsely();
  const WorkingPoints moved(source, Eigen::Translation3d(-overlap_.reference) * guess_);
  const WorkingPoints fixed(target, Affine3d(Eigen::Translation3d(-overlap_.reference)));
  std::vector<AreaSurfaces> areas = prepareAreas(moved, fixed);
  result_.overlap_area = overlap_.area;
  if (!registerDetermined(areas))
    return fail(Status::too_few_pairs, "only " + std::to_string(pairs_.size()) +
                                           " points lie on a smooth surface of the other cloud");
  return result_;
}

void check(const PatchAlignmentSettings& settings) {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw UsageError(std::string("patch alignment: ") + name + " must be more than 0 m, not " +
                       std::to_string(value));
  };
  positive(settings.search_distance, "search distance");
  positive(settings.convergence, "convergence");
  positive(settings.determined_std, "largest determined standard deviation");
  positive(settings.resolution, "resolution");
  if (settings.maximum_iterations < 1 || settings.points < 100 || settings.pairs < 100)
    throw UsageError("patch alignment: iterations must be at least 1, points and pairs 100");
}

}  // namespace

PatchAlignmentResult registerPatches(const PointView& source, const PointView& target,
                                     const PatchAlignmentSettings& settings,
                                     const Affine3d& guess) {
  check(settings);
  return Alignment(settings, guess).run(source, target);
}

}  // namespace pcl_als
