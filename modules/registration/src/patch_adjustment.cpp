// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "patch_adjustment.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <pcl_als/adjustment/correlated_errors.h>
#include <pcl_als/adjustment/robust_iteration.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als::registration {
namespace {

constexpr std::array<double, 3> kTiltSteps{0.087, 0.26, 0.5};  // sines: 5, 15, 30 degrees
constexpr double kNoiseFactor = 3.0;  // the roughness may understate the noise of normals
constexpr std::size_t kFewestInStep = 30;
constexpr double kLeastScatter = 1e-6;  // metres
constexpr std::size_t kChunk = 8192;
constexpr int kPasses = 3;        // solutions from the same pairs
constexpr double kChance = 0.05;  // of larger variances between parts, without shared errors
constexpr std::size_t kFewestStrips = 6;  // of cells, excluded one at a time
// The contribution of the noise of normals to the normal matrix is a mean: a sample of pairs
// suffices.
constexpr std::size_t kNoiseSample = 8, kEnoughToSample = 20'000;

std::size_t chunks(std::size_t count) {
  return (count + kChunk - 1) / kChunk;
}

}  // namespace

Unknowns AdjustmentFrame::rowOf(const PatchPair& pair) const {
  const Eigen::Vector3d arm = (pair.position - centre) / radius;
  Unknowns row;
  row << pair.normal, arm.cross(pair.normal), with_scale ? pair.normal.dot(arm) : 0.0;
  return row;
}

UnknownsMatrix AdjustmentFrame::noiseOf(const PatchPair& pair) const {
  const Eigen::Vector3d arm = (pair.position - centre) / radius;
  const Eigen::Vector3d u = pair.normal.unitOrthogonal(), v = pair.normal.cross(u);
  UnknownsMatrix sum = UnknownsMatrix::Zero();
  for (const Eigen::Vector3d& tangent : {u, v}) {
    Unknowns row;
    row << tangent, arm.cross(tangent), with_scale ? tangent.dot(arm) : 0.0;
    sum.noalias() += (pair.tilt_variance * row) * row.transpose();
  }
  return sum;
}

Eigen::Affine3d AdjustmentFrame::motionOf(const Unknowns& unknowns) const {
  const Eigen::Vector3d turn = unknowns.segment<3>(3) / radius;
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.translate(centre + unknowns.head<3>());
  if (turn.norm() > 0.0) motion.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  motion.scale(1.0 + unknowns[6] / radius);
  motion.translate(-centre);
  return motion;
}

void NormalEquations::add(const Unknowns& row, double rest, double weight) {
  matrix.noalias() += (weight * row) * row.transpose();
  right -= weight * rest * row;
  weights += weight;
}

void NormalEquations::merge(const NormalEquations& other) {
  matrix += other.matrix;
  noise += other.noise;
  right += other.right;
  weights += other.weights;
}

int ScatterBySlope::stepOf(const PatchPair& pair) {
  const double tilt = pair.normal.head<2>().squaredNorm();
  int step = 0;
  while (step + 1 < kSteps && tilt > kTiltSteps[step] * kTiltSteps[step]) ++step;
  return step;
}

double ScatterBySlope::all() const {
  double squares = 0.0, count = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    squares += static_cast<double>(pairs[i]) * sigma[i] * sigma[i];
    count += static_cast<double>(pairs[i]);
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

PatchAdjustment::PatchAdjustment(const PatchPairs& pairs, const AdjustmentFrame& frame,
                                 const RobustWeight& robust, int threads)
    : pairs_(pairs), equations_(pairs.size()), frame_(frame), robust_(robust), threads_(threads) {
  parallelFor(chunks(pairs_.size()), threads_, [&](std::size_t chunk) {
    const std::size_t end = std::min(pairs_.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i)
      equations_[i] = {frame_.rowOf(pairs_[i]), pairs_[i].distance, std::sqrt(pairs_[i].variance),
                       ScatterBySlope::stepOf(pairs_[i])};
  });
}

ScatterBySlope PatchAdjustment::scatter(const Unknowns& unknowns) const {
  std::vector<double> rests(equations_.size());
  parallelFor(chunks(equations_.size()), threads_, [&](std::size_t chunk) {
    const std::size_t end = std::min(equations_.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i)
      rests[i] = (equations_[i].distance + equations_[i].row.dot(unknowns)) / equations_[i].root;
  });
  std::array<std::vector<double>, ScatterBySlope::kSteps> steps;
  steps[0].reserve(equations_.size());
  for (std::size_t i = 0; i < rests.size(); ++i) steps[equations_[i].step].push_back(rests[i]);
  ScatterBySlope result;
  std::optional<double> of_all;
  for (int i = 0; i < ScatterBySlope::kSteps; ++i) {
    result.pairs[i] = steps[i].size();
    if (result.pairs[i] == 0) continue;
    const bool few = result.pairs[i] < kFewestInStep;
    if (few && !of_all) of_all = robustSigma(rests);
    // About zero and not about the median, so that a class with an offset has a larger scatter.
    result.sigma[i] =
        std::max(few ? *of_all : robustSigmaAboutZero(std::move(steps[i])), kLeastScatter);
  }
  // Where the scatter is held, pairs of such a class may be formed later.
  const double largest = result.largest();
  for (int i = 0; i < ScatterBySlope::kSteps; ++i)
    if (result.pairs[i] == 0) result.sigma[i] = largest;
  return result;
}

double PatchAdjustment::weightOf(double rest, const Equation& equation,
                                 const ScatterBySlope& scatter) const {
  const double sigma = scatter.sigma[equation.step] * equation.root;
  return robust_(rest, sigma) / (sigma * sigma);
}

NormalEquations PatchAdjustment::accumulate(const Unknowns& unknowns,
                                            const ScatterBySlope& scatter) const {
  std::vector<NormalEquations> parts(chunks(pairs_.size()));
  const std::size_t sample = pairs_.size() < kEnoughToSample ? 1 : kNoiseSample;
  const auto of_sample = static_cast<double>(sample);
  parallelFor(parts.size(), threads_, [&](std::size_t chunk) {
    NormalEquations sum;
    const std::size_t end = std::min(pairs_.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const Equation& equation = equations_[i];
      const double rest = equation.distance + equation.row.dot(unknowns);
      const double weight = weightOf(rest, equation, scatter);
      if (weight == 0.0) continue;
      sum.add(equation.row, rest, weight);
      if (i % sample == 0 && pairs_[i].tilt_variance > 0.0)
        sum.noise += of_sample * weight * frame_.noiseOf(pairs_[i]);
    }
    parts[chunk] = sum;
  });
  NormalEquations all;
  for (const NormalEquations& part : parts) all.merge(part);
  return all;
}

Unknowns PatchAdjustment::solve(double limit, double prior, Weighting& weighting) const {
  Unknowns update = Unknowns::Zero();
  const auto weigh = [&] {
    if (!weighting.frozen) weighting.scatter = scatter(update);
  };
  weigh();
  reweight(
      kPasses, kConvergedChange,
      [&] {
        const NormalEquations equations = accumulate(update, weighting.scatter);
        if (!weighting.frozen)
          weighting.directions = analyse(equations, frame_.unknowns(), limit, weighting.held);
        const Unknowns change =
            solveDetermined(equations, weighting.directions, 1.0 / (prior * prior));
        update += change;
        return std::optional(
            std::sqrt(change.dot(equations.right) / static_cast<double>(pairs_.size())));
      },
      weigh);
  return update;
}

std::vector<NormalEquations> PatchAdjustment::accumulateGroups(const ScatterBySlope& scatter,
                                                               std::size_t groups) const {
  std::vector<NormalEquations> all(groups);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Equation& equation = equations_[i];
    const double weight = weightOf(equation.distance, equation, scatter);
    if (weight > 0.0) all[pairs_[i].group].add(equation.row, equation.distance, weight);
  }
  return all;
}

UnknownsMatrix PatchAdjustment::correlated(const ScatterBySlope& scatter,
                                           const Directions& directions) const {
  const int strong = directions.strong();
  if (strong == 0) return UnknownsMatrix::Zero();
  const Eigen::MatrixXd basis = directions.basis();
  CorrelatedErrors errors(strong, 3);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Equation& equation = equations_[i];
    const double weight = weightOf(equation.distance, equation, scatter);
    if (weight == 0.0) continue;
    const CorrelatedErrors::Row row = basis.transpose() * equation.row;
    errors.add(pairs_[i].position.head<2>(), row, pairs_[i].normal, weight, equation.distance);
  }
  const CorrelatedErrors::Result result = errors.solve();
  if (!result.determined) return UnknownsMatrix::Zero();
  return basis * result.covariance * basis.transpose();
}

Directions analyse(const NormalEquations& equations, int unknowns, double limit,
                   const HeldDirections& held) {
  Directions directions;
  directions.unknowns = unknowns;
  directions.weights = equations.weights;
  directions.held = directions.weak = static_cast<int>(held.vectors.size());
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(unknowns, unknowns);
  if (directions.held > 0) {
    Eigen::MatrixXd vectors(unknowns, directions.held);
    for (int i = 0; i < directions.held; ++i)
      vectors.col(i) = held.vectors[static_cast<std::size_t>(i)].head(unknowns);
    basis << vectors, orthogonalComplement(vectors);
  }
  const UnknownsMatrix sure = equations.matrix - kNoiseFactor * equations.noise;
  const Eigen::MatrixXd part = sure.topLeftCorner(unknowns, unknowns);
  if (const int others = unknowns - directions.held; others > 0) {
    const Eigen::MatrixXd free = basis.rightCols(others);
    basis.rightCols(others) = free * symmetricEigen(free.transpose() * part * free).vectors;
  }
  directions.vectors.topLeftCorner(unknowns, unknowns) = basis;
  directions.values.head(unknowns) = (basis.transpose() * part * basis).diagonal().cwiseMax(0.0);
  const double least = 1.0 / (limit * limit);
  while (directions.weak < unknowns && !(directions.values[directions.weak] > least))
    ++directions.weak;
  for (int i = 0; i < directions.weak; ++i) {
    directions.std[i] = i < directions.held
                            ? held.std[static_cast<std::size_t>(i)]
                            : 1.0 / std::sqrt(std::max(directions.values[i], 1e-12));
  }
  return directions;
}

Unknowns solveDetermined(const NormalEquations& equations, const Directions& directions,
                         double prior_information) {
  if (directions.strong() == 0) return Unknowns::Zero();
  const Eigen::MatrixXd basis = directions.basis();
  Eigen::MatrixXd normal = basis.transpose() * equations.matrix * basis;
  normal.diagonal().array() += prior_information;
  return basis * solveSymmetric(normal, basis.transpose() * equations.right);
}

UnknownsMatrix cofactor(const NormalEquations& equations, const Directions& directions) {
  if (directions.strong() == 0) return UnknownsMatrix::Zero();
  const Eigen::MatrixXd basis = directions.basis();
  const Eigen::MatrixXd normal = basis.transpose() * equations.matrix * basis;
  return basis * inverseOfRegular(normal) * basis.transpose();
}

UnknownsMatrix jackknife(const std::vector<NormalEquations>& groups, const Directions& directions,
                         std::size_t fewest) {
  const int strong = directions.strong();
  if (strong == 0) return UnknownsMatrix::Zero();
  const Eigen::MatrixXd basis = directions.basis();
  NormalEquations all;
  for (const NormalEquations& group : groups) all.merge(group);
  std::vector<Eigen::VectorXd> solutions;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(strong);
  for (const NormalEquations& group : groups) {
    if (group.weights == 0.0) continue;
    const Eigen::MatrixXd rest = basis.transpose() * (all.matrix - group.matrix) * basis;
    solutions.push_back(solveSymmetric(rest, basis.transpose() * (all.right - group.right)));
    mean += solutions.back();
  }
  if (solutions.size() < fewest) return UnknownsMatrix::Zero();
  const auto count = static_cast<double>(solutions.size());
  mean /= count;
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(strong, strong);
  for (const Eigen::VectorXd& solution : solutions)
    scatter += (solution - mean) * (solution - mean).transpose();
  return basis * (scatter * ((count - 1.0) / count)) * basis.transpose();
}

namespace {

/// Cells by the columns and rows of larger cells.
std::vector<NormalEquations> merged(const std::vector<NormalEquations>& cells, const PlanGrid& grid,
                                    int columns, int rows) {
  const int across = (grid.columns + columns - 1) / columns;
  const int up = (grid.rows + rows - 1) / rows;
  std::vector<NormalEquations> groups(static_cast<std::size_t>(across) * up);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int index = static_cast<int>(i);
    const int column = index % grid.columns / columns, row = index / grid.columns / rows;
    groups[static_cast<std::size_t>(row * across + column)].merge(cells[i]);
  }
  return groups;
}

}  // namespace

UnknownsMatrix jackknifeOfParts(const std::vector<NormalEquations>& cells, const PlanGrid& grid,
                                const Directions& directions) {
  const UnknownsMatrix covariance = jackknife(cells, directions);
  Unknowns largest = covariance.diagonal(), raise = Unknowns::Zero();
  const std::pair<std::vector<NormalEquations>, std::size_t> divisions[] = {
      {merged(cells, grid, 2, 2), kFewestGroups},
      {merged(cells, grid, 1, grid.rows), kFewestStrips},
      {merged(cells, grid, grid.columns, 1), kFewestStrips}};
  for (const auto& [groups, fewest] : divisions) {
    const Unknowns variances = jackknife(groups, directions, fewest).diagonal();
    const double freedom = static_cast<double>(groups.size()) - 1.0;
    const double by_chance = chiSquaredCritical(kChance, freedom) / freedom;
    for (int i = 0; i < directions.unknowns; ++i)
      if (variances[i] > by_chance * covariance(i, i))
        largest[i] = std::max(largest[i], variances[i]);
  }
  for (int i = 0; i < directions.unknowns; ++i)
    if (covariance(i, i) > 0.0) raise[i] = std::sqrt(largest[i] / covariance(i, i));
  return raise.asDiagonal() * covariance * raise.asDiagonal();
}

}  // namespace pcl_als::registration
