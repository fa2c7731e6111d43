// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <vector>

#include <pcl_als/adjustment/correlated_errors.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {
namespace {

// Size of cells in metres; halved where there are too few cells, doubled while there are too many.
constexpr double kCell = 25.0, kSmallestCell = 12.5;
constexpr std::size_t kEnoughCells = 16;
constexpr std::size_t kMostCells = 100;  // of one component: a decomposition takes milliseconds
constexpr std::size_t kMostCellsOfThree = 40;
constexpr std::size_t kFewestCells = 4;
constexpr double kIndependent = 0.8;   // prior probability that errors of cells are independent
constexpr int kRanges = 6;             // of the grid, besides independent cells
constexpr double kLongestRange = 0.6;  // of the extent
constexpr double kInPlan[] = {1.0, 10.0, 100.0};  // variances in plan over the vertical one
/// Variances of the shared error over those of the noise, in a cell.
constexpr double kShares[] = {0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0};
constexpr double kNothing = 1e-9;  // of the largest: an eigenvalue of no information

std::int64_t keyOf(std::int64_t column, std::int64_t row) {
  return row * (std::int64_t{1} << 31) + column;
}

/// Adds weight a b'. Loops over so few entries take a fraction of the time of a general product.
void addProduct(double weight, const CorrelatedErrors::Row& a, const CorrelatedErrors::Row& b,
                CorrelatedErrors::Matrix& sum) {
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const double weighted = weight * a[i];
    for (Eigen::Index j = 0; j < b.size(); ++j) sum(i, j) += weighted * b[j];
  }
}

/// The scores of all cells, scaled to unit noise: w = X b + F u + e.
struct Scaled {
  Eigen::MatrixXd design;               ///< X
  Eigen::VectorXd values;               ///< w
  Eigen::MatrixXd effects;              ///< F: one row for each value, a column for each component
  std::vector<Eigen::Vector2d> places;  ///< of each value
};

/// Sums over the grid of covariances, each with its likelihood.
class Average {
 public:
  void add(double log_likelihood, const Eigen::MatrixXd& covariance, double range, double share) {
    if (log_likelihood > largest_) {
      const double factor = std::exp(largest_ - log_likelihood);
      weight_ *= factor;
      sum_ *= factor;
      logarithms_ *= factor;
      largest_ = log_likelihood;
      range_ = range;
      share_ = share;
    }
    const double weight = std::exp(log_likelihood - largest_);
    if (sum_.size() == 0) {
      sum_ = Eigen::MatrixXd::Zero(covariance.rows(), covariance.cols());
      logarithms_ = Eigen::VectorXd::Zero(covariance.rows());
    }
    sum_ += weight * covariance;
    logarithms_ += weight * covariance.diagonal().array().max(1e-300).log().matrix();
    weight_ += weight;
  }
  /// Geometric means of the variances: arithmetic means would be dominated by the few longest and
  /// least likely ranges.
  Eigen::MatrixXd mean() const {
    const Eigen::VectorXd geometric = (logarithms_ / weight_).array().exp();
    const Eigen::MatrixXd mean = sum_ / weight_;
    const Eigen::VectorXd factor = (geometric.array() / mean.diagonal().array().max(1e-300)).sqrt();
    return factor.asDiagonal() * mean * factor.asDiagonal();
  }
  double range() const { return range_; }
  double share() const { return share_; }

 private:
  Eigen::MatrixXd sum_;
  Eigen::VectorXd logarithms_;
  double weight_ = 0.0, largest_ = -1e300, range_ = 0.0, share_ = 0.0;
};

Eigen::MatrixXd kernel(const Scaled& scaled, double range, double in_plan) {
  const auto n = static_cast<Eigen::Index>(scaled.places.size());
  Eigen::VectorXd variances = Eigen::VectorXd::Ones(scaled.effects.cols());
  if (variances.size() == 3) variances.head<2>().setConstant(in_plan);
  Eigen::MatrixXd matrix = scaled.effects * variances.asDiagonal() * scaled.effects.transpose();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const double distance = (scaled.places[i] - scaled.places[j]).norm();
      matrix(i, j) *= range > 0.0 ? std::exp(-distance / range) : (distance > 0.0 ? 0.0 : 1.0);
    }
  return matrix;
}

/// Restricted likelihood and covariance for all shares of one kernel.
void addKernel(const Scaled& scaled, const Eigen::MatrixXd& rest, const Eigen::MatrixXd& inverse,
               double range, double in_plan, double log_prior, Average& average) {
  const Eigen::MatrixXd matrix = kernel(scaled, range, in_plan);
  const auto eigen = symmetricEigen(rest.transpose() * matrix * rest);
  const Eigen::ArrayXd values = eigen.values.array().max(0.0);
  const Eigen::ArrayXd squares =
      (eigen.vectors.transpose() * (rest.transpose() * scaled.values)).array().square();
  const Eigen::MatrixXd shared =
      inverse * (scaled.design.transpose() * matrix * scaled.design) * inverse;
  const auto redundancy = static_cast<double>(values.size());
  const double scale = matrix.trace() / static_cast<double>(matrix.rows());
  for (const double share : kShares) {
    const Eigen::ArrayXd variance = 1.0 + share / scale * values;
    const double sum = (squares / variance).sum();
    const double log_likelihood = -0.5 * (variance.log().sum() + redundancy * std::log(sum));
    average.add(log_prior + log_likelihood,
                sum / (redundancy - 2.0) * (inverse + share / scale * shared), range,
                share / (1.0 + share));
  }
}

/// RMS distance of cells from their centre, times the factor for the ends of a line.
double extentOf(const std::vector<Eigen::Vector2d>& places) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& place : places) mean += place / static_cast<double>(places.size());
  double squares = 0.0;
  for (const Eigen::Vector2d& place : places) squares += (place - mean).squaredNorm();
  return std::sqrt(12.0 * squares / static_cast<double>(places.size()));
}

}  // namespace

CorrelatedErrors::CorrelatedErrors(int unknowns, int components)
    : unknowns_(unknowns), components_(components) {
  if (unknowns < 1 || unknowns > kMostUnknowns)
    throw UsageError("correlated errors: 1 to 7 unknowns");
  if (components != 1 && components != 3) throw UsageError("correlated errors: 1 or 3 components");
  normal_ = Matrix::Zero(unknowns, unknowns);
}

void CorrelatedErrors::add(const Eigen::Vector2d& place, const Row& row, const Row& effect,
                           double weight, double residual) {
  if (row.size() != unknowns_ || effect.size() != components_)
    throw UsageError("correlated errors: a row or an effect of another size");
  const auto index = [](double v) {
    return static_cast<std::int64_t>(std::floor(v / kSmallestCell));
  };
  Cell& cell = cells_[keyOf(index(place.x()), index(place.y()))];
  if (cell.count == 0.0) {
    cell.effects = Matrix::Zero(components_, components_);
    cell.mixed = Matrix::Zero(components_, unknowns_);
    cell.score = Row::Zero(components_);
  }
  cell.count += 1.0;
  cell.place += place;
  addProduct(weight, effect, effect, cell.effects);
  addProduct(weight, effect, row, cell.mixed);
  cell.score.noalias() += weight * residual * effect;
  addProduct(weight, row, row, normal_);
}

CorrelatedErrors::Cells CorrelatedErrors::doubled(const Cells& cells, double size) {
  const auto index = [size](double v) {
    return static_cast<std::int64_t>(std::floor(v / (2.0 * size)));
  };
  Cells larger;
  for (const auto& [key, cell] : cells) {
    const Eigen::Vector2d place = cell.place / cell.count;
    const auto [into, added] = larger.emplace(keyOf(index(place.x()), index(place.y())), cell);
    if (added) continue;
    into->second.count += cell.count;
    into->second.place += cell.place;
    into->second.effects += cell.effects;
    into->second.mixed += cell.mixed;
    into->second.score += cell.score;
  }
  return larger;
}

CorrelatedErrors::Cells CorrelatedErrors::merged(double& size) const {
  const std::size_t most = components_ == 1 ? kMostCells : kMostCellsOfThree;
  Cells cells = cells_;
  for (size = kSmallestCell;; size *= 2.0) {
    Cells larger = doubled(cells, size);
    if (cells.size() <= most && (size >= kCell || larger.size() < kEnoughCells)) return cells;
    cells = std::move(larger);
  }
}

CorrelatedErrors::Result CorrelatedErrors::solve() const {
  Result result;
  double size = kSmallestCell;
  const Cells cells = merged(size);
  result.cells = cells.size();
  if (cells.size() < kFewestCells) return result;
  Scaled scaled;
  const auto most = static_cast<Eigen::Index>(cells.size()) * components_;
  scaled.design.resize(most, unknowns_);
  scaled.values.resize(most);
  scaled.effects.resize(most, components_);
  Eigen::Index n = 0;
  for (const auto& [key, cell] : cells) {
    const auto eigen = symmetricEigen(cell.effects);
    for (int k = 0; k < components_; ++k) {
      const double information = eigen.values[k];
      if (!(information > kNothing * eigen.values[components_ - 1])) continue;
      const Eigen::VectorXd direction = eigen.vectors.col(k);
      scaled.design.row(n) = direction.transpose() * cell.mixed / std::sqrt(information);
      scaled.values[n] = direction.dot(cell.score) / std::sqrt(information);
      scaled.effects.row(n++) = std::sqrt(information) * direction.transpose();
      scaled.places.emplace_back(cell.place / cell.count);
    }
  }
  scaled.design.conservativeResize(n, Eigen::NoChange);
  scaled.values.conservativeResize(n);
  scaled.effects.conservativeResize(n, Eigen::NoChange);
  const Eigen::MatrixXd rest = orthogonalComplement(scaled.design);
  const Eigen::MatrixXd inverse = inverseOrEmpty(normal_);
  if (rest.cols() < 3 || inverse.size() == 0) return result;
  result.determined = true;
  if (!((rest.transpose() * scaled.values).squaredNorm() > 0.0)) {
    result.covariance = Matrix::Zero(unknowns_, unknowns_);
    return result;
  }
  Average average;
  const double longest = std::max(kLongestRange * extentOf(scaled.places), size);
  for (const double in_plan : kInPlan) {
    if (components_ == 1 && in_plan != 1.0) continue;
    addKernel(scaled, rest, inverse, 0.0, in_plan, std::log(kIndependent), average);
    for (int i = 0; i < kRanges; ++i) {
      const double range = size * std::pow(longest / size, i / (kRanges - 1.0));
      addKernel(scaled, rest, inverse, range, in_plan, std::log((1.0 - kIndependent) / kRanges),
                average);
    }
  }
  result.covariance = average.mean();
  result.range = average.range();
  result.share = average.share();
  return result;
}

}  // namespace pcl_als
