// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "change_detection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include <Eigen/Cholesky>

#include <pcl_als/common/distributions.h>

#include "mission_variance.h"

namespace pcl_als::detail {
namespace {

// Shares of the level that the kinds of changes have: steps are what systems mostly do.
constexpr double kStepShare = 0.8, kOutlierShare = 0.1, kDriftShare = 0.1;
constexpr std::size_t kFewestForTrend = 4;  // missions that show an outlier or a drift
constexpr int kSimulations = 2000;          // of the largest statistic: levels of 0.04 to 5 %
constexpr double kLeastProbability = 0.9;   // of changes rather than random variation

struct Candidate {
  ParameterChange change;
  HistoryTerm term;
  double variance = 0.0;  ///< of the score
  double z = 0.0;
};

/// Missions that determine a parameter.
std::vector<std::size_t> missionsWith(const std::vector<CalibrationMission>& missions, int p) {
  std::vector<std::size_t> found;
  for (std::size_t m = 0; m < missions.size(); ++m)
    if (missions[m].determines(static_cast<SystemParameter>(p))) found.push_back(m);
  return found;
}

Candidate candidateOf(ChangeKind kind, int p, std::size_t before, std::size_t after,
                      Eigen::VectorXd design) {
  Candidate candidate;
  candidate.change.kind = kind;
  candidate.change.parameter = static_cast<SystemParameter>(p);
  candidate.change.last_before = before;
  candidate.change.first_after = after;
  candidate.term = {p, std::move(design), 0.0, kind != ChangeKind::outlier};
  return candidate;
}

/// A quantity that a parameter may depend on; empty where a mission lacks it or all are equal.
struct Covariate {
  std::string name;
  Eigen::VectorXd values;
};

std::vector<Covariate> covariatesOf(const std::vector<CalibrationMission>& missions, bool dated) {
  const auto count = static_cast<Eigen::Index>(missions.size());
  std::vector<Covariate> covariates(1);
  covariates[0] = {dated ? "date" : "mission", Eigen::VectorXd::LinSpaced(count, 1.0, count)};
  if (dated) {
    for (Eigen::Index m = 0; m < count; ++m)
      covariates[0].values[m] =
          static_cast<double>(*missions[static_cast<std::size_t>(m)].day - *missions.back().day);
  } else {
    covariates[0].values.array() -= static_cast<double>(count);
  }
  std::set<std::string> names;
  for (const CalibrationMission& mission : missions)
    for (const auto& [name, value] : mission.covariates) names.insert(name);
  for (const std::string& name : names) {
    Covariate covariate{name, Eigen::VectorXd(count)};
    bool complete = true;
    for (Eigen::Index m = 0; m < count; ++m) {
      const auto& values = missions[static_cast<std::size_t>(m)].covariates;
      const auto found = values.find(name);
      complete = complete && found != values.end();
      covariate.values[m] = complete ? found->second : 0.0;
    }
    // Centred: the value of the parameter is that at the mean of the covariate.
    covariate.values.array() -= covariate.values.mean();
    if (complete) covariates.push_back(std::move(covariate));
  }
  return covariates;
}

class Detection {
 public:
  Detection(const std::vector<CalibrationMission>& missions, const HistoryOptions& options,
            bool dated)
      : missions_(missions),
        options_(options),
        change_std_(
            options.change_std.array().isNaN().select(SystemVector::Zero(), options.change_std)),
        data_(informationOf(missions, change_std_)) {
    for (int p = 0; p < kSystemParameterCount; ++p) addCandidates(p, covariatesOf(missions, dated));
  }

  std::vector<DetectedChange> run() {
    while (changes_.size() < missions_.size()) {
      const HistoryModel model(data_, terms());
      score(model);
      const Candidate* best = mostLikely(model);
      if (best == nullptr) break;
      changes_.push_back({best->change, best->term});
      compareWithVariation(best->term.parameter);
    }
    for (int p = 0; p < kSystemParameterCount; ++p) removePending(p);
    return changes_;
  }

 private:
  void addCandidates(int p, const std::vector<Covariate>& covariates) {
    const std::vector<std::size_t> with = missionsWith(missions_, p);
    const auto count = static_cast<Eigen::Index>(missions_.size());
    for (std::size_t i = 1; i < with.size(); ++i) {
      Eigen::VectorXd design = Eigen::VectorXd::Zero(count);
      design.tail(count - static_cast<Eigen::Index>(with[i])).setOnes();
      candidates_.push_back(candidateOf(ChangeKind::step, p, with[i - 1], with[i], design));
    }
    if (with.size() < kFewestForTrend) return;
    for (std::size_t i = 1; i + 1 < with.size(); ++i)
      candidates_.push_back(
          candidateOf(ChangeKind::outlier, p, with[i], with[i],
                      Eigen::VectorXd::Unit(count, static_cast<Eigen::Index>(with[i]))));
    for (const Covariate& covariate : covariates) {
      candidates_.push_back(
          candidateOf(ChangeKind::drift, p, with.front(), with.back(), covariate.values));
      candidates_.back().change.covariate = covariate.name;
    }
  }

  std::vector<HistoryTerm> terms() const {
    std::vector<HistoryTerm> terms = constantTerms(missions_);
    for (const DetectedChange& change : changes_) terms.push_back(change.term);
    return terms;
  }

  void score(const HistoryModel& model) {
    const std::vector<SystemVector> residuals = model.residuals(data_.vector);
    for (Candidate& candidate : candidates_) {
      candidate.variance = model.scoreVariance(candidate.term);
      candidate.z = zOf(candidate, residuals);
    }
  }

  static double zOf(const Candidate& candidate, const std::vector<SystemVector>& residuals) {
    if (!(candidate.variance > 0.0)) return 0.0;
    double score = 0.0;
    for (std::size_t m = 0; m < residuals.size(); ++m)
      score += candidate.term.design[static_cast<Eigen::Index>(m)] *
               residuals[m][candidate.term.parameter];
    return score / std::sqrt(candidate.variance);
  }

  double countOf(ChangeKind kind) const {
    return static_cast<double>(
        std::count_if(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
          return candidate.change.kind == kind && candidate.variance > 0.0;
        }));
  }

  static double shareOf(ChangeKind kind) {
    if (kind == ChangeKind::step) return kStepShare;
    return kind == ChangeKind::outlier ? kOutlierShare : kDriftShare;
  }

  /// The most likely significant change; null: there is none.
  Candidate* mostLikely(const HistoryModel& model) {
    Candidate* best = nullptr;
    double largest = 0.0;
    for (const ChangeKind kind : {ChangeKind::step, ChangeKind::outlier, ChangeKind::drift}) {
      Candidate* candidate = largestOf(kind);
      if (candidate == nullptr) continue;
      const double z = std::abs(candidate->z), count = countOf(kind);
      candidate->change.p_value = std::min(1.0, 2.0 * count * normalTail(z));
      const double level = shareOf(kind) * options_.level;
      // Statistics of neighbouring steps are correlated, and Bonferroni's inequality is wide.
      if (kind == ChangeKind::step && candidate->change.p_value < 10.0 * level)
        candidate->change.p_value =
            std::min(candidate->change.p_value, simulatedProbability(model, z));
      const double likelihood = 0.5 * z * z - std::log(count);
      if (candidate->change.p_value > level || (best != nullptr && likelihood <= largest)) continue;
      best = candidate;
      largest = likelihood;
    }
    if (best != nullptr && best->change.kind == ChangeKind::step) setPositionProbability(*best);
    return best;
  }

  Candidate* largestOf(ChangeKind kind) {
    Candidate* best = nullptr;
    for (Candidate& candidate : candidates_) {
      if (candidate.change.kind != kind || !(candidate.variance > 0.0)) continue;
      if (varies_[static_cast<std::size_t>(candidate.term.parameter)]) continue;
      if (best == nullptr || std::abs(candidate.z) > std::abs(best->z)) best = &candidate;
    }
    return best;
  }

  /// Of steps of the same parameter, by their likelihoods with equal prior probabilities.
  void setPositionProbability(Candidate& step) const {
    double sum = 0.0;
    for (const Candidate& other : candidates_) {
      if (other.change.kind != ChangeKind::step || other.term.parameter != step.term.parameter)
        continue;
      sum += std::exp(0.5 * (other.z * other.z - step.z * step.z));
    }
    step.change.position_probability = 1.0 / sum;
  }

  /// Probability of a larger statistic of any step where no further term is needed.
  double simulatedProbability(const HistoryModel& model, double z) const {
    std::vector<SystemMatrix> roots;
    for (const SystemMatrix& information : data_.matrix) roots.push_back(rootOf(information));
    std::mt19937_64 generator(1);
    std::normal_distribution<double> normal;
    std::vector<SystemVector> vectors(roots.size());
    int larger = 0;
    for (int i = 0; i < kSimulations; ++i) {
      for (std::size_t m = 0; m < roots.size(); ++m)
        vectors[m] = roots[m] * SystemVector::NullaryExpr([&] { return normal(generator); });
      const std::vector<SystemVector> residuals = model.residuals(vectors);
      larger +=
          std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
            return candidate.change.kind == ChangeKind::step &&
                   std::abs(zOf(candidate, residuals)) >= z;
          });
    }
    return (1.0 + larger) / (1.0 + kSimulations);
  }

  /// A matrix whose product with its transpose is the information matrix, rows of zeros included.
  static SystemMatrix rootOf(const SystemMatrix& information) {
    const SystemVector diagonal = information.diagonal();
    const SystemVector scale =
        (diagonal.array() > 0.0).select(diagonal.cwiseSqrt(), SystemVector::Ones());
    SystemMatrix scaled =
        scale.cwiseInverse().asDiagonal() * information * scale.cwiseInverse().asDiagonal();
    for (int p = 0; p < kSystemParameterCount; ++p)
      if (!(diagonal[p] > 0.0)) scaled(p, p) = 1.0;
    const Eigen::LLT<SystemMatrix> factor(scaled);
    SystemMatrix root = scale.asDiagonal() * SystemMatrix(factor.matrixL());
    for (int p = 0; p < kSystemParameterCount; ++p)
      if (!(diagonal[p] > 0.0)) root.row(p).setZero();
    return root;
  }

  /// Accepts the last changes of a parameter where they explain the missions better than random
  /// variation. One more change may show that; else the parameter varies, and has no changes.
  void compareWithVariation(int p) {
    const auto at = static_cast<std::size_t>(p);
    constexpr int kMostPending = 2;
    ++pending_[at];
    const Comparison comparison = compare(p);
    if (comparison.probability >= kLeastProbability) {
      int left = pending_[at];
      for (auto change = changes_.rbegin(); left > 0; ++change) {
        if (change->term.parameter != p) continue;
        change->change.probability = comparison.probability;
        --left;
      }
      pending_[at] = 0;
    } else if (pending_[at] == kMostPending) {
      removePending(p);
      varies_[at] = true;
      change_std_[p] = comparison.variation;
      data_ = informationOf(missions_, change_std_);
    }
  }

  void removePending(int p) {
    for (int& left = pending_[static_cast<std::size_t>(p)]; left > 0; --left) {
      const auto last =
          std::find_if(changes_.rbegin(), changes_.rend(),
                       [p](const DetectedChange& change) { return change.term.parameter == p; });
      changes_.erase(std::next(last).base());
    }
  }

  struct Comparison {
    double probability = 1.0;  ///< of the pending changes rather than random variation
    double variation = 0.0;    ///< most likely standard deviation of the latter
  };

  Comparison compare(int p) const {
    if (!std::isnan(options_.change_std[p])) return {};  // the variation is known
    std::vector<HistoryTerm> without = constantTerms(missions_);
    double penalty = 0.0;
    const double scale = 0.5 * std::log(static_cast<double>(missionsWith(missions_, p).size()));
    int accepted = -pending_[static_cast<std::size_t>(p)];
    for (const DetectedChange& change : changes_) accepted += change.term.parameter == p;
    for (const DetectedChange& change : changes_) {
      const bool is_pending = change.term.parameter == p && accepted-- <= 0;
      if (!is_pending)
        without.push_back(change.term);
      else
        penalty += scale + std::log(std::max(1.0, countOf(p, change.change.kind)));
    }
    const MostLikelyChange a = mostLikelyChange(missions_, p, change_std_, terms(), false);
    const MostLikelyChange b = mostLikelyChange(missions_, p, change_std_, without, false);
    penalty += scale * ((a.std > 0.0 ? 1.0 : 0.0) - (b.std > 0.0 ? 1.0 : 0.0));
    return {1.0 / (1.0 + std::exp(-(a.log_likelihood - b.log_likelihood - penalty))), b.std};
  }

  double countOf(int p, ChangeKind kind) const {
    return static_cast<double>(
        std::count_if(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
          return candidate.change.kind == kind && candidate.term.parameter == p;
        }));
  }

  const std::vector<CalibrationMission>& missions_;
  const HistoryOptions& options_;
  SystemVector change_std_;  ///< of parameters that vary at random
  MissionInformation data_;
  std::vector<Candidate> candidates_;
  std::vector<DetectedChange> changes_;
  std::array<int, kSystemParameterCount> pending_{};  ///< changes that are not accepted yet
  std::array<bool, kSystemParameterCount> varies_{};
};

}  // namespace

std::vector<DetectedChange> detectChanges(const std::vector<CalibrationMission>& missions,
                                          const HistoryOptions& options, bool dated) {
  return Detection(missions, options, dated).run();
}

}  // namespace pcl_als::detail
