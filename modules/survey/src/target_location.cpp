// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/survey/target_location.h>

namespace pcl_als {
namespace {

constexpr std::size_t kFewestPoints = 20;  // in the search window
constexpr double kFewestOnTarget = 2.5;    // returns
// Logarithm of the Bayes factor of a target against none: a thousand to one.
constexpr double kDecisive = 6.9;
constexpr double kLeastContrast = 4.0;      // difference of the levels over the noise
constexpr double kLargestStd = 0.5;         // radii: of the centre, in its least certain direction
constexpr double kSeparationInRadii = 1.0;  // radii from the mean: another place of the target
constexpr double kOutsideProbability =
    0.01;                       // probability of other places, and of the window's edge
constexpr double kLocal = 2.2;  // radii: ground next to the target
// Returns between the target's edge and the end of the ground next to it.
constexpr double kLocalSpacings = 2.5;
constexpr double kCertain = 2.5;   // standard deviations from the edge of returns on the target
constexpr double kEdgeZone = 1.5;  // blurs
constexpr double kTexture = 0.35;  // share of the noise of intensities that varies slowly
// Returns with the brightness of the other side: blurs from the edge, and how many are accepted.
constexpr double kMargin = 1.5, kAllowedOutliers = 1.0, kShareWrong = 0.02;

// The a priori standard deviation of the difference of the levels, over the noise.
constexpr double kPriorContrast = 100.0;
// Least noise, over the scatter of all intensities and in digital numbers (rounding).
constexpr double kLeastNoise = 0.01, kRounding = 0.3;

constexpr std::array<double, 5> kBlurs{0.5, 0.8, 1.25, 2.0, 2.8};        // times the expected one
constexpr std::array<double, 5> kEdgeNoises{0.0, 1.5, 4.0, 10.0, 25.0};  // k
constexpr double kLeastBlur = 0.01, kLargestBlur = 0.6;                  // radii
constexpr double kEnd = 3.5;          // blurs from the edge beyond which h is 0 or 1
constexpr double kStepOfBlur = 0.7;   // least blur over the step of a grid
constexpr double kStepOfStd = 0.6;    // largest step of the last grid over the standard deviation
constexpr double kNegligible = 16.0;  // logarithm of the ratio to the largest probability
constexpr int kMostGrids = 12;

double logSum(const std::vector<double>& values) {
  const double largest = *std::max_element(values.begin(), values.end());
  double sum = 0.0;
  for (const double value : values) sum += std::exp(value - largest);
  return largest + std::log(sum);
}

/// Sums of the linear model of two levels.
struct LevelSums {
  double weight = 0.0, h = 0.0, hh = 0.0, y = 0.0, hy = 0.0, yy = 0.0, log_weight = 0.0;

  void add(double value, double at, double w) {
    weight += w;
    h += w * at;
    hh += w * at * at;
    y += w * value;
    hy += w * at * value;
    yy += w * value * value;
  }
};

/// The probability of the intensities for a centre.
class DiscLikelihood {
 public:
  struct Fit {
    double log_likelihood = 0.0, contrast = 0.0;
  };

  DiscLikelihood(const std::vector<TargetPoint>& points, double radius) : radius_(radius) {
    double mean = 0.0, squares = 0.0;
    for (const TargetPoint& p : points) mean += p.intensity;
    mean /= static_cast<double>(points.size());
    for (const TargetPoint& p : points) squares += std::pow(p.intensity - mean, 2);
    const double scatter = std::sqrt(squares / static_cast<double>(points.size()));
    const double unit = scatter > 0.0 ? 1.0 / scatter : 0.0;
    for (const TargetPoint& p : points) points_.push_back({p.place, unit * (p.intensity - mean)});
    least_variance_ = std::pow(std::max(kLeastNoise, kRounding * unit), 2);
    for (const TargetPoint& p : points_) all_.add(p.intensity, 0.0, 1.0);
  }

  /// The sums of all returns but those at the edge, which are listed with their h.
  LevelSums sortedOut(const Eigen::Vector2d& centre, double blur);
  Fit at(const LevelSums& without_edge, double edge_noise) const;
  double logWithoutTarget() const { return fitOf(all_).log_likelihood; }
  double onTarget(const Eigen::Vector2d& centre, double blur) {
    double count = sortedOut(centre, blur).h;
    for (const AtEdge& p : edge_) count += p.h;
    return count;
  }

 private:
  Fit fitOf(const LevelSums& sums) const;

  std::vector<TargetPoint> points_;  ///< intensities with a mean of zero and a scatter of one
  double radius_, least_variance_ = 0.0;
  LevelSums all_;
  struct AtEdge {
    double h, intensity;
    double nearness;  ///< to the edge: 1 on it
  };
  std::vector<AtEdge> edge_;
};

LevelSums DiscLikelihood::sortedOut(const Eigen::Vector2d& centre, double blur) {
  const double inner = std::max(0.0, radius_ - kEnd * blur), outer = radius_ + kEnd * blur;
  LevelSums sums = all_;
  edge_.clear();
  for (const TargetPoint& p : points_) {
    const double squared = (p.place - centre).squaredNorm();
    if (squared > outer * outer) continue;
    const double y = p.intensity;
    if (squared < inner * inner) {
      sums.h += 1.0;
      sums.hh += 1.0;
      sums.hy += y;
      continue;
    }
    const double x = (radius_ - std::sqrt(squared)) / blur;
    const double h = 0.5 * std::erfc(-x * std::sqrt(0.5));
    edge_.push_back({h, y, 4.0 * h * (1.0 - h)});
    sums.add(y, 0.0, -1.0);
  }
  return sums;
}

DiscLikelihood::Fit DiscLikelihood::at(const LevelSums& without_edge, double edge_noise) const {
  LevelSums sums = without_edge;
  double product = 1.0;  // of the variances; its logarithm is taken now and then
  for (const AtEdge& p : edge_) {
    const double variance = 1.0 + edge_noise * edge_noise * p.nearness;
    sums.add(p.intensity, p.h, 1.0 / variance);
    product *= variance;
    if (product < 1e100) continue;
    sums.log_weight -= std::log(product);
    product = 1.0;
  }
  sums.log_weight -= std::log(product);
  return fitOf(sums);
}

DiscLikelihood::Fit DiscLikelihood::fitOf(const LevelSums& sums) const {
  const auto count = static_cast<double>(points_.size());
  const double hh = sums.hh + 1.0 / (kPriorContrast * kPriorContrast);
  const double schur = hh - sums.h * sums.h / sums.weight;
  const double right = sums.hy - sums.h * sums.y / sums.weight;
  const double contrast = right / schur;
  const double squares = sums.yy - sums.y * sums.y / sums.weight - contrast * right;
  const double variance = std::max(0.0, squares) / count + least_variance_;
  Fit fit;
  fit.contrast = std::abs(contrast) / std::sqrt(variance);
  fit.log_likelihood = 0.5 * sums.log_weight - 0.5 * std::log(sums.weight * schur) -
                       0.5 * (count - 1.0) * std::log(variance);
  return fit;
}

/// The posterior of the centre on a grid.
struct Posterior {
  struct Cell {
    Eigen::Vector2d centre;
    double log_probability = 0.0;
  };
  std::vector<Cell> cells;
  double step = 0.0;
  double blur = 0.0, contrast = 0.0;  ///< of the most probable centre
  double log_evidence = 0.0;          ///< against no target, with equal probability in the window
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  void evaluate(DiscLikelihood& likelihood, double expected_blur, double radius);
  void refine();
  void summarise(double area);
  double largestStd() const { return std::sqrt(symmetricEigenvalues2(covariance)[1]); }
  double smallestStd() const { return std::sqrt(symmetricEigenvalues2(covariance)[0]); }
  /// Sum of the probabilities of cells with a property.
  template <typename Property>
  double probability(const Property& property) const {
    double with = 0.0, all = 0.0;
    for (const Cell& cell : cells) {
      all += weightOf(cell);
      if (property(cell.centre)) with += weightOf(cell);
    }
    return with / all;
  }
  /// The probability over that of the most probable cell.
  double weightOf(const Cell& cell) const {
    return std::exp(cell.log_probability - cells.front().log_probability);
  }
};

void Posterior::evaluate(DiscLikelihood& likelihood, double expected_blur, double radius) {
  std::vector<double> blurs;
  for (const double factor : kBlurs) {
    const double blur =
        std::clamp(factor * expected_blur, kLeastBlur * radius, kLargestBlur * radius);
    const double wide = std::max(blur, kStepOfBlur * step);
    if (blurs.empty() || wide > blurs.back()) blurs.push_back(wide);
  }
  double best = -HUGE_VAL;
  std::vector<double> terms;
  for (Cell& cell : cells) {
    terms.clear();
    for (const double at : blurs) {
      const LevelSums sums = likelihood.sortedOut(cell.centre, at);
      for (const double edge_noise : kEdgeNoises) {
        const DiscLikelihood::Fit fit = likelihood.at(sums, edge_noise);
        terms.push_back(fit.log_likelihood);
        if (fit.log_likelihood <= best) continue;
        best = fit.log_likelihood;
        blur = at;
        contrast = fit.contrast;
      }
    }
    cell.log_probability =
        logSum(terms) - std::log(static_cast<double>(terms.size())) - likelihood.logWithoutTarget();
  }
  std::sort(cells.begin(), cells.end(),
            [](const Cell& a, const Cell& b) { return a.log_probability > b.log_probability; });
}

void Posterior::summarise(double area) {
  double sum = 0.0;
  mean.setZero();
  covariance.setZero();
  const Eigen::Vector2d origin = cells.front().centre;
  for (const Cell& cell : cells) {
    const double p = weightOf(cell);
    const Eigen::Vector2d from = cell.centre - origin;
    sum += p;
    mean += p * from;
    covariance += p * from * from.transpose();
  }
  mean /= sum;
  covariance = covariance / sum - mean * mean.transpose();
  covariance.diagonal().array() += step * step / 12.0;
  mean += origin;
  log_evidence = cells.front().log_probability + std::log(sum * step * step / area);
}

/// Divides the cells that are not improbable into four.
void Posterior::refine() {
  std::vector<Cell> finer;
  for (const Cell& cell : cells) {
    if (cell.log_probability < cells.front().log_probability - kNegligible) break;
    for (const double x : {-0.25, 0.25})
      for (const double y : {-0.25, 0.25})
        finer.push_back({cell.centre + step * Eigen::Vector2d(x, y)});
  }
  cells = std::move(finer);
  step *= 0.5;
}

Posterior posteriorOf(const std::vector<TargetPoint>& points, const TargetSearch& search) {
  DiscLikelihood likelihood(points, search.radius);
  Posterior posterior;
  const int half = std::max(2, static_cast<int>(std::ceil(2.0 * search.window / search.radius)));
  posterior.step = search.window / half;
  for (int i = -half; i < half; ++i)
    for (int k = -half; k < half; ++k)
      posterior.cells.push_back(
          {search.centre + posterior.step * Eigen::Vector2d(i + 0.5, k + 0.5)});
  const double area = 4.0 * search.window * search.window;
  for (int grid = 0; grid < kMostGrids; ++grid) {
    if (grid > 0) posterior.refine();
    posterior.evaluate(likelihood, search.blur, search.radius);
    posterior.summarise(area);
    if (posterior.step < kStepOfStd * posterior.smallestStd()) break;
  }
  return posterior;
}

TargetStatus statusOf(const Posterior& posterior, const TargetSearch& search) {
  if (posterior.log_evidence < kDecisive) return TargetStatus::no_contrast;
  const double edge = search.window - std::max(posterior.step, 0.1 * search.radius);
  const auto atEdge = [&](const Eigen::Vector2d& place) {
    return (place - search.centre).cwiseAbs().maxCoeff() > edge;
  };
  if (posterior.probability(atEdge) > kOutsideProbability) return TargetStatus::at_edge;
  const auto apart = [&](const Eigen::Vector2d& place) {
    return (place - posterior.mean).norm() > kSeparationInRadii * search.radius;
  };
  if (posterior.probability(apart) > kOutsideProbability ||
      posterior.largestStd() > kLargestStd * search.radius)
    return TargetStatus::ambiguous;
  return TargetStatus::located;
}

/// The returns within a distance of a place, in each coordinate or all around.
std::vector<TargetPoint> pointsNear(const std::vector<TargetPoint>& points,
                                    const Eigen::Vector2d& centre, double reach, bool round) {
  std::vector<TargetPoint> near;
  for (const TargetPoint& p : points) {
    const Eigen::Vector2d from = p.place - centre;
    if ((round ? from.norm() : from.cwiseAbs().maxCoeff()) <= reach) near.push_back(p);
  }
  return near;
}

/// Adds what the likelihood does not contain: errors of the coordinates of the returns at the edge,
/// and brightness of the ground that varies slowly along it.
void addSystematic(const std::vector<TargetPoint>& points, const TargetSearch& search,
                   TargetLocation& location) {
  double at_edge = 0.0;
  for (const TargetPoint& p : points)
    if (std::abs((p.place - location.centre).norm() - search.radius) < kEdgeZone * location.blur)
      at_edge += 1.0;
  const double coordinates = 2.0 * search.noise * search.noise / std::max(2.0, at_edge);
  constexpr double kRootOfTwoPi = 2.5066;  // times the blur: inverse slope of h at the edge
  const double texture = kTexture * kRootOfTwoPi * location.blur / location.contrast;
  location.covariance.diagonal().array() += coordinates + texture * texture;
}

/// Whether returns away from the edge have the brightness of the other side: another object, or a
/// target of another shape.
bool isContradicted(const std::vector<TargetPoint>& points, const TargetSearch& search,
                    const TargetLocation& location) {
  const double tolerance =
      kMargin * search.blur + kCertain * std::sqrt(location.covariance.trace());
  double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
  const auto sideOf = [&](const TargetPoint& p) {  // 1: on the target, 0: beside it, -1: unknown
    const double inside = search.radius - (p.place - location.centre).norm();
    return std::abs(inside) < tolerance ? -1 : inside > 0.0 ? 1 : 0;
  };
  for (const TargetPoint& p : points) {
    const int side = sideOf(p);
    if (side < 0) continue;
    sums[side] += p.intensity;
    counts[side] += 1.0;
  }
  if (counts[0] == 0.0 || counts[1] == 0.0) return false;
  const double levels[2] = {sums[0] / counts[0], sums[1] / counts[1]};
  const double middle = 0.5 * (levels[0] + levels[1]);
  double wrong = 0.0;
  for (const TargetPoint& p : points) {
    const int side = sideOf(p);
    if (side >= 0 && (p.intensity > middle) != (levels[side] > middle)) wrong += 1.0;
  }
  return wrong > kAllowedOutliers + kShareWrong * (counts[0] + counts[1]);
}

void listCertain(const std::vector<TargetPoint>& points, double radius, TargetLocation& location) {
  const double std = std::sqrt(location.covariance.trace());
  const double inner = radius - kCertain * (std + location.blur);
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((points[i].place - location.centre).norm() < inner)
      location.certain.push_back(static_cast<int>(i));
}

}  // namespace

std::string_view reasonOf(TargetStatus status) {
  constexpr std::array<std::string_view, 5> kReasons{
      "located", "too few points", "no contrast of intensity of this size",
      "its place is ambiguous", "it is displaced too far"};
  return kReasons[static_cast<std::size_t>(status)];
}

TargetLocation locateTarget(const std::vector<TargetPoint>& points, const TargetSearch& search) {
  TargetLocation location;
  const double reach = search.window + 1.5 * search.radius;
  const std::vector<TargetPoint> all = pointsNear(points, search.centre, reach, false);
  if (all.size() < kFewestPoints) return location;
  const Posterior first = posteriorOf(all, search);
  location.status = statusOf(first, search);
  if (!location.located()) return location;

  TargetSearch nearby = search;
  nearby.centre = first.mean;
  nearby.window = 0.5 * search.radius + 4.0 * first.largestStd();
  const double spacing = 2.0 * reach / std::sqrt(static_cast<double>(all.size()));
  const double local = std::max(kLocal * search.radius, search.radius + kLocalSpacings * spacing);
  const std::vector<TargetPoint> around =
      pointsNear(all, first.mean, local + first.largestStd(), true);
  if (around.size() < 3) return {};
  const Posterior last = posteriorOf(around, nearby);
  location.status = statusOf(last, nearby);
  location.centre = last.mean;
  location.covariance = last.covariance;
  location.contrast = last.contrast;
  location.blur = last.blur;
  DiscLikelihood counted(around, search.radius);
  location.on_target = counted.onTarget(last.mean, last.blur);
  if (!location.located()) return location;
  if (isContradicted(around, search, location)) location.status = TargetStatus::ambiguous;
  addSystematic(around, search, location);
  if (location.contrast < kLeastContrast) location.status = TargetStatus::no_contrast;
  if (location.on_target < kFewestOnTarget) location.status = TargetStatus::too_few_points;
  listCertain(points, search.radius, location);
  return location;
}

}  // namespace pcl_als
