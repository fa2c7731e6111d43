// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include <pcl_als/calibration/adjustment.h>
#include <pcl_als/common/parallel.h>

namespace pcl_als {
namespace {

constexpr int kKnot = SharedErrors::kPerKnot;
constexpr int kSlots =
    5;  // knots around the firing of the point and around that of the patch, instrument
constexpr int kLocal = kSystemParameterCount + kSlots * kKnot;
using LocalRow = Eigen::Matrix<double, 1, kLocal>;
using Knots = std::array<int, kSlots>;  // -1: not used

/// One observation's row over what it touches: the eight parameters, then four knots and the
/// instrument.
struct TouchedRow {
  LocalRow row = LocalRow::Zero();
  Knots knots{-1, -1, -1, -1, -1};

  TouchedRow(const PairObservation& observation, const SharedErrors& errors) {
    row.head<kSystemParameterCount>() = observation.row();
    if (observation.a != PairObservation::kControl) {
      place(0, errors.placeOf(observation.a, observation.time_a), observation.normal,
            observation.row_a, 1.0);
    }
    place(2, errors.placeOf(observation.b, observation.time_b), observation.normal,
          observation.row_b, -1.0);
    knots[4] = errors.instrumentBlock();
    row[kSystemParameterCount + 4 * kKnot] = observation.stretch;
  }

 private:
  void place(int slot, const SharedErrors::Place& where, const Eigen::Vector3d& normal,
             const SystemRow& design, double sign) {
    Eigen::Matrix<double, 1, kKnot> effect;
    effect << normal.transpose(), design.segment<3>(indexOf(SystemParameter::boresight_pitch));
    knots[slot] = where.knot;
    row.segment<kKnot>(kSystemParameterCount + slot * kKnot) = sign * (1.0 - where.next) * effect;
    if (where.next_knot == where.knot) return;
    knots[slot + 1] = where.next_knot;
    row.segment<kKnot>(kSystemParameterCount + (slot + 1) * kKnot) = sign * where.next * effect;
  }
};

/// Normal equations of consecutive observations that touch the same knots.
struct PartialNormal {
  Knots knots;
  Eigen::Matrix<double, kLocal, kLocal> matrix = Eigen::Matrix<double, kLocal, kLocal>::Zero();
  Eigen::Matrix<double, kLocal, 1> right = Eigen::Matrix<double, kLocal, 1>::Zero();
};

std::vector<PartialNormal> partialNormals(const AreaObservations& observations,
                                          const std::vector<double>& weights,
                                          const SharedErrors& errors) {
  std::map<Knots, PartialNormal> partial;
  PartialNormal* current = nullptr;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const TouchedRow touched(observations[i], errors);
    if (current == nullptr || current->knots != touched.knots) {
      current = &partial[touched.knots];
      current->knots = touched.knots;
    }
    const double weight = weights[i] / observations[i].variance;
    const LocalRow weighted = weight * touched.row;
    current->matrix.noalias() += weighted.transpose() * touched.row;
    current->right += observations[i].misclosure * weighted.transpose();
  }
  std::vector<PartialNormal> list;
  for (auto& entry : partial) list.push_back(entry.second);
  return list;
}

Eigen::MatrixXd sub(const SystemMatrix& matrix, const std::vector<SystemParameter>& chosen) {
  Eigen::MatrixXd part(chosen.size(), chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = 0; j < chosen.size(); ++j)
      part(i, j) = matrix(indexOf(chosen[i]), indexOf(chosen[j]));
  }
  return part;
}

SystemMatrix expanded(const Eigen::MatrixXd& part, const std::vector<SystemParameter>& chosen) {
  SystemMatrix matrix = SystemMatrix::Zero();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = 0; j < chosen.size(); ++j)
      matrix(indexOf(chosen[i]), indexOf(chosen[j])) = part(i, j);
  }
  return matrix;
}

/// Inverse of a symmetric matrix whose parameters have different units; false when it is
/// numerically singular.
bool invert(const Eigen::MatrixXd& matrix, Eigen::MatrixXd& inverse) {
  if (!matrix.allFinite() || (matrix.diagonal().array() <= 0.0).any()) return false;
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(scale.asDiagonal() * matrix * scale.asDiagonal());
  constexpr double kSingular = 1e-11;  // of a matrix with a unit diagonal
  if (ldlt.info() != Eigen::Success || ldlt.vectorD().minCoeff() < kSingular) return false;
  inverse = scale.asDiagonal() *
            ldlt.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols())) *
            scale.asDiagonal();
  return true;
}

}  // namespace

/// The whole system, before elimination.
struct Adjustment::Normal {
  SystemMatrix gg = SystemMatrix::Zero();
  SystemVector right_g = SystemVector::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, kSystemParameterCount> tg;
  Eigen::VectorXd right_t;
  std::map<std::pair<int, int>, Eigen::Matrix<double, kKnot, kKnot>> tt;

  explicit Normal(int unknowns) {
    tg.setZero(unknowns, kSystemParameterCount);
    right_t.setZero(unknowns);
  }

  void add(const PartialNormal& part) {
    gg += part.matrix.topLeftCorner<kSystemParameterCount, kSystemParameterCount>();
    right_g += part.right.head<kSystemParameterCount>();
    for (int i = 0; i < kSlots; ++i) {
      if (part.knots[i] < 0) continue;
      const int local_i = kSystemParameterCount + i * kKnot;
      tg.middleRows<kKnot>(part.knots[i] * kKnot) +=
          part.matrix.block<kKnot, kSystemParameterCount>(local_i, 0);
      right_t.segment<kKnot>(part.knots[i] * kKnot) += part.right.segment<kKnot>(local_i);
      for (int j = 0; j < kSlots; ++j) {
        if (part.knots[j] < 0) continue;
        auto& block = tt.try_emplace({part.knots[i], part.knots[j]},
                                     Eigen::Matrix<double, kKnot, kKnot>::Zero())
                          .first->second;
        block += part.matrix.block<kKnot, kKnot>(local_i, kSystemParameterCount + j * kKnot);
      }
    }
  }

  Eigen::SparseMatrix<double> sparse() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [knots, block] : tt) {
      for (int r = 0; r < kKnot; ++r) {
        for (int c = 0; c < kKnot; ++c) {
          entries.emplace_back(knots.first * kKnot + r, knots.second * kKnot + c, block(r, c));
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(right_t.size(), right_t.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
};

/// The system with the shared errors eliminated.
struct Adjustment::Reduced {
  SystemMatrix normal, prior_share;
  SystemVector right;
  Eigen::Matrix<double, Eigen::Dynamic, kSystemParameterCount> elimination;  ///< N_tt^-1 N_tg
  Eigen::VectorXd eliminated_right;                                          ///< N_tt^-1 h_t
  double log_determinant = 0.0;  ///< ln |N_tt| - ln |prior|
  double explained = 0.0;        ///< h_t' N_tt^-1 h_t
};

Adjustment::Adjustment(const SharedErrors& errors, int threads)
    : errors_(errors), threads_(threads) {}
Adjustment::~Adjustment() = default;

void Adjustment::accumulate(const std::vector<AreaObservations>& areas,
                            const std::vector<std::vector<double>>& weights) {
  areas_ = &areas;
  weights_ = &weights;
  std::vector<std::vector<PartialNormal>> partial(areas.size());
  parallelFor(areas.size(), threads_, [&](std::size_t area) {
    partial[area] = partialNormals(areas[area], weights[area], errors_);
  });
  normal_ = std::make_unique<Normal>(errors_.unknowns());
  for (const auto& area :
       partial) {  // in area order: the sums do not depend on the number of threads
    for (const PartialNormal& part : area) normal_->add(part);
  }
  reduced_ = std::make_unique<Reduced>(reduce(levels_));
}

void Adjustment::setLevels(const SharedErrorLevels& levels) {
  levels_ = levels;
  if (normal_) reduced_ = std::make_unique<Reduced>(reduce(levels_));
}

Adjustment::Reduced Adjustment::reduce(const SharedErrorLevels& levels) const {
  const Eigen::SparseMatrix<double> prior = errors_.priorInformation(levels);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(normal_->sparse() + prior);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> prior_ldlt(prior);
  Reduced reduced;
  reduced.elimination = ldlt.solve(normal_->tg);
  reduced.eliminated_right = ldlt.solve(normal_->right_t);
  reduced.normal = normal_->gg - normal_->tg.transpose() * reduced.elimination;
  reduced.normal = (0.5 * (reduced.normal + reduced.normal.transpose())).eval();
  reduced.right = normal_->right_g - normal_->tg.transpose() * reduced.eliminated_right;
  reduced.prior_share = reduced.elimination.transpose() * (prior * reduced.elimination);
  reduced.log_determinant =
      ldlt.vectorD().array().log().sum() - prior_ldlt.vectorD().array().log().sum();
  reduced.explained = normal_->right_t.dot(reduced.eliminated_right);
  return reduced;
}

double Adjustment::deviance(const SharedErrorLevels& levels,
                            const std::vector<SystemParameter>& estimate) const {
  const Reduced reduced = reduce(levels);
  Eigen::MatrixXd inverse;
  const Eigen::MatrixXd normal = sub(reduced.normal, estimate);
  if (!invert(normal, inverse)) return std::numeric_limits<double>::infinity();
  Eigen::VectorXd right(estimate.size());
  for (std::size_t i = 0; i < estimate.size(); ++i) right[i] = reduced.right[indexOf(estimate[i])];
  const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> scaled(scale.asDiagonal() * normal * scale.asDiagonal());
  const double log_normal = scaled.vectorD().array().log().sum() - 2.0 * scale.array().log().sum();
  return reduced.log_determinant + log_normal - reduced.explained - right.dot(inverse * right);
}

const SystemMatrix& Adjustment::reducedNormal() const {
  return reduced_->normal;
}

double Adjustment::residual(const PairObservation& observation,
                            const AdjustmentSolution& solution) const {
  const TouchedRow touched(observation, errors_);
  double left =
      observation.misclosure - touched.row.head<kSystemParameterCount>() * solution.biases;
  for (int slot = 0; slot < kSlots; ++slot) {
    if (touched.knots[slot] < 0) continue;
    left -= touched.row.segment<kKnot>(kSystemParameterCount + slot * kKnot) *
            solution.shared.segment<kKnot>(touched.knots[slot] * kKnot);
  }
  return left;
}

SystemMatrix Adjustment::scoreScatter(const AdjustmentSolution& solution) const {
  std::vector<SystemVector> scores(areas_->size(), SystemVector::Zero());
  parallelFor(areas_->size(), threads_, [&](std::size_t area) {
    for (std::size_t i = 0; i < (*areas_)[area].size(); ++i) {
      const PairObservation& observation = (*areas_)[area][i];
      const TouchedRow touched(observation, errors_);
      SystemRow reduced = touched.row.head<kSystemParameterCount>();
      for (int slot = 0; slot < kSlots; ++slot) {
        if (touched.knots[slot] < 0) continue;
        reduced -= touched.row.segment<kKnot>(kSystemParameterCount + slot * kKnot) *
                   reduced_->elimination.middleRows<kKnot>(touched.knots[slot] * kKnot);
      }
      const double weight = (*weights_)[area][i] / observation.variance;
      scores[area] += weight * residual(observation, solution) * reduced.transpose();
    }
  });
  SystemMatrix scatter = SystemMatrix::Zero();
  double groups = 0.0;
  for (std::size_t area = 0; area < scores.size(); ++area) {
    if (!(*areas_)[area].empty()) groups += 1.0;
    scatter += scores[area] * scores[area].transpose();
  }
  return groups > 1.0 ? SystemMatrix(scatter * (groups / (groups - 1.0))) : scatter;
}

AdjustmentSolution Adjustment::solve(const std::vector<SystemParameter>& estimate,
                                     const SystemVector& held) const {
  AdjustmentSolution solution;
  solution.biases = held;
  for (const SystemParameter p : estimate) solution.biases[indexOf(p)] = 0.0;
  Eigen::MatrixXd inverse, formal;
  if (!invert(sub(reduced_->normal, estimate), inverse) ||
      !invert(sub(normal_->gg, estimate), formal))
    return solution;
  const SystemMatrix model = expanded(inverse, estimate);
  solution.biases += model * (reduced_->right - reduced_->normal * solution.biases);
  solution.shared = reduced_->eliminated_right - reduced_->elimination * solution.biases;
  solution.formal = expanded(formal, estimate);
  const SystemMatrix robust = model * (scoreScatter(solution) + reduced_->prior_share) * model;
  SystemVector inflation = SystemVector::Ones();
  for (const SystemParameter p : estimate) {
    const int i = indexOf(p);
    inflation[i] = std::max(1.0, std::sqrt(robust(i, i) / model(i, i)));
  }
  solution.covariance = inflation.asDiagonal() * model * inflation.asDiagonal();
  solution.solved = true;
  return solution;
}

SharedErrorLevels mostLikelyLevels(const Adjustment& adjustment,
                                   const std::vector<SystemParameter>& estimate) {
  constexpr int kLowest = -12, kHighest = 3;  // powers of two
  constexpr double kBelief = 2.0;  // standard deviation of ln(level) by the model's own word
  std::array<int, 3> best{0, 0, 0};
  const auto levelsOf = [](const std::array<int, 3>& power) {
    return SharedErrorLevels{std::exp2(power[0]), std::exp2(power[1]), std::exp2(power[2])};
  };
  const auto cost = [&](const std::array<int, 3>& power) {
    double belief = 0.0;
    for (const int p : power) belief += std::pow(p * std::log(2.0) / kBelief, 2);
    return adjustment.deviance(levelsOf(power), estimate) + belief;
  };
  double lowest = cost(best);
  for (bool changed = true; changed;) {
    changed = false;
    for (int kind = 0; kind < 3; ++kind) {
      for (const int step : {-1, 1}) {
        for (std::array<int, 3> next = best;;) {
          next[kind] += step;
          if (next[kind] < kLowest || next[kind] > kHighest) break;
          const double value = cost(next);
          if (!(value < lowest)) break;
          lowest = value;
          best = next;
          changed = true;
        }
      }
    }
  }
  return levelsOf(best);
}

}  // namespace pcl_als
