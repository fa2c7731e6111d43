// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/radiometry/overlap_adjustment.h>
#include <pcl_als/radiometry/radiometric_cells.h>

#include "overlap_equations.h"

namespace pcl_als {
namespace {

constexpr std::size_t kFewClusters = 20;

struct TermInfo {
  const char *name, *unit;
  double RadiometricModel::*value;
};
constexpr TermInfo kTerms[kRadiometricTermCount] = {
    {"range_exponent", "1", &RadiometricModel::range_exponent},
    {"incidence_exponent", "1", &RadiometricModel::incidence_exponent},
    {"extinction", "1/km", &RadiometricModel::extinction_per_km}};

std::string number(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

/// For every strip the lowest strip that it is connected to through shared cells.
std::vector<int> groupsOf(const std::vector<SharedCell>& cells, std::size_t strips) {
  std::vector<int> parent(strips);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int strip) {
    while (parent[static_cast<std::size_t>(strip)] != strip)
      strip = parent[static_cast<std::size_t>(strip)];
    return strip;
  };
  for (const SharedCell& cell : cells) {
    for (const SharedCell::View& view : cell.views) {
      const int a = root(cell.views.front().strip), b = root(view.strip);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<int> groups(strips);
  for (std::size_t i = 0; i < strips; ++i) groups[i] = root(static_cast<int>(i));
  return groups;
}

/// One adjustment: keeps dropping the worst term until all that remain are determined.
class Adjustment {
 public:
  Adjustment(const std::vector<SharedCell>& cells, double cell_size,
             const std::vector<std::string>& strips, const RadiometricModel& model,
             const OverlapSettings& settings)
      : strips_(strips),
        settings_(settings),
        groups_(groupsOf(cells, strips.size())),
        equations_(cells, cell_size, model, settings.cluster_size),
        wanted_(settings.estimate) {
    result_.model = model;
    result_.cells = cells.size();
    result_.observations = equations_.observations();
    result_.gains.resize(strips.size());
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t)
      result_.terms[t].value = model.*kTerms[t].value;
    for (EstimatedTerm& gain : result_.gains) gain.value = 1.0;
  }

  OverlapResult run() {
    if (result_.cells < settings_.least_cells) return tooFew();
    do {
      chooseUnknowns();
      solution_ = equations_.solve(unknowns_);
      expand();
    } while (dropWorst());
    store();
    return result_;
  }

 private:
  OverlapResult tooFew() {
    const std::string reason = "only " + std::to_string(result_.cells) +
                               " smooth cells are covered by two strips; " +
                               std::to_string(settings_.least_cells) + " are needed";
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t)
      if (wanted_[t]) refuse(t, reason);
    for (EstimatedTerm& gain : result_.gains)
      if (settings_.estimate_gains) gain.status = TermStatus::not_estimable, gain.reason = reason;
    result_.warnings.push_back(reason);
    result_.converged = true;
    return result_;
  }

  void refuse(std::size_t term, const std::string& reason) {
    wanted_[term] = false;
    result_.terms[term].status = TermStatus::not_estimable;
    result_.terms[term].reason = reason;
  }

  void chooseUnknowns() {
    unknowns_ = detail::OverlapUnknowns();
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t)
      if (wanted_[t]) unknowns_.term[t] = unknowns_.count++;
    unknowns_.gain.assign(strips_.size(), -1);
    for (std::size_t i = 0; settings_.estimate_gains && i < strips_.size(); ++i)
      if (groups_[i] != static_cast<int>(i)) unknowns_.gain[i] = unknowns_.count++;
  }

  /// From gains against one strip of the group to gains with mean (of logarithms) zero in it.
  void expand() {
    const int terms = static_cast<int>(std::count(wanted_.begin(), wanted_.end(), true));
    const auto strips = static_cast<int>(strips_.size());
    const int gains = settings_.estimate_gains ? strips : 0;
    Eigen::MatrixXd transform = Eigen::MatrixXd::Zero(terms + gains, unknowns_.count);
    transform.topLeftCorner(terms, terms).setIdentity();
    for (int i = 0; i < gains; ++i) {
      const auto members =
          static_cast<double>(std::count(groups_.begin(), groups_.end(), group(i)));
      for (int j = 0; j < strips; ++j) {
        const int column = unknowns_.gain[static_cast<std::size_t>(j)];
        if (column < 0 || group(j) != group(i)) continue;
        transform(terms + i, column) = (i == j ? 1.0 : 0.0) - 1.0 / members;
      }
    }
    values_ = transform * solution_.unknowns;
    if (!solution_.outcome.solved()) return;
    covariance_ = transform * solution_.covariance * transform.transpose();
    formal_ = transform * solution_.formal * transform.transpose();
  }
  int group(int strip) const { return groups_[static_cast<std::size_t>(strip)]; }

  /// The name of the other parameter that a row of the covariance is most correlated with.
  std::string twinOf(int row) const {
    int twin = -1;
    double most = 0.7;
    for (int other = 0; other < covariance_.rows(); ++other) {
      if (other == row || covariance_(other, other) <= 0.0) continue;
      const double r =
          covariance_(row, other) / std::sqrt(covariance_(row, row) * covariance_(other, other));
      if (std::abs(r) > most) most = std::abs(r), twin = other;
    }
    if (twin < 0) return "it varies too little in these overlaps";
    return "it cannot be separated from " + nameOfRow(twin) + " (correlation " + number(most) + ")";
  }
  std::string nameOfRow(int row) const {
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t)
      if (unknowns_.term[t] == row) return kTerms[t].name;
    const int terms = static_cast<int>(std::count(wanted_.begin(), wanted_.end(), true));
    return "the gain of strip " + strips_[static_cast<std::size_t>(row - terms)];
  }

  /// True where a term was set back to its given value, so that the others are solved again.
  bool dropWorst() {
    if (!solution_.outcome.solved()) {
      for (const std::size_t t : {2U, 0U, 1U}) {
        if (!wanted_[t]) continue;
        refuse(t, std::string("the overlaps do not determine it: ") + solution_.outcome.reason());
        return true;
      }
      return false;
    }
    double worst = 1.0;
    std::size_t drop = kRadiometricTermCount;
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t) {
      if (!wanted_[t]) continue;
      const int row = unknowns_.term[t];
      const double ratio = std::sqrt(covariance_(row, row)) / settings_.largest_std[t];
      if (ratio > worst) worst = ratio, drop = t;
    }
    if (drop == kRadiometricTermCount) return false;
    const int row = unknowns_.term[drop];
    refuse(drop, "its standard deviation would be " + number(std::sqrt(covariance_(row, row))) +
                     ": " + twinOf(row));
    return true;
  }

  void store() {
    result_.converged = solution_.outcome.converged();
    result_.iterations = solution_.outcome.passes;
    result_.sigma0 = solution_.sigma0;
    result_.clusters = solution_.clusters;
    if (!solution_.outcome.solved()) return;
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t)
      if (wanted_[t]) storeTerm(t);
    if (settings_.estimate_gains) storeGains();
    storeCorrelation();
    if (result_.clusters < kFewClusters)
      result_.warnings.push_back("the overlaps span only " + std::to_string(result_.clusters) +
                                 " areas of " + number(settings_.cluster_size) +
                                 " m: standard deviations are rough");
  }

  void storeTerm(std::size_t t) {
    EstimatedTerm& term = result_.terms[t];
    const int row = unknowns_.term[t];
    term.value += values_[row];
    term.std = std::sqrt(covariance_(row, row));
    term.std_formal = std::sqrt(formal_(row, row));
    term.status = TermStatus::estimated;
    if (term.value < 0.0) {
      result_.warnings.push_back(std::string(kTerms[t].name) + " came out as " +
                                 number(term.value) + ", which is impossible; 0 is used");
      term.value = 0.0;
    }
    result_.model.*kTerms[t].value = term.value;
  }

  void storeGains() {
    const auto terms = static_cast<int>(values_.size() - static_cast<Eigen::Index>(strips_.size()));
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      EstimatedTerm& gain = result_.gains[i];
      const int row = terms + static_cast<int>(i);
      if (std::count(groups_.begin(), groups_.end(), groups_[i]) < 2) {
        gain.status = TermStatus::not_estimable;
        gain.reason = "no other strip overlaps it in smooth cells";
        continue;
      }
      gain.value = std::exp(values_[row]);
      gain.std = std::sqrt(covariance_(row, row));
      gain.std_formal = std::sqrt(formal_(row, row));
      gain.status = gain.std <= settings_.largest_gain_std ? TermStatus::estimated
                                                           : TermStatus::not_estimable;
      if (gain.status == TermStatus::estimated) continue;
      gain.reason = "its standard deviation is " + number(gain.std) + ": " + twinOf(row);
    }
    if (std::any_of(groups_.begin(), groups_.end(), [this](int g) { return g != groups_[0]; }))
      result_.warnings.push_back(
          "not all strips are connected by overlaps: gains are relative within "
          "each group of strips only");
  }

  void storeCorrelation() {
    for (int row = 0; row < covariance_.rows(); ++row) {
      const std::string name = nameOfRow(row);
      result_.order.push_back(name.rfind("the gain of strip ", 0) == 0 ? "gain " + name.substr(18)
                                                                       : name);
    }
    const Eigen::VectorXd sigma = covariance_.diagonal().cwiseSqrt().cwiseMax(1e-150);
    result_.correlation =
        sigma.cwiseInverse().asDiagonal() * covariance_ * sigma.cwiseInverse().asDiagonal();
  }

  const std::vector<std::string>& strips_;
  const OverlapSettings& settings_;
  std::vector<int> groups_;
  detail::OverlapEquations equations_;
  std::array<bool, kRadiometricTermCount> wanted_;
  detail::OverlapUnknowns unknowns_;
  detail::OverlapSolution solution_;
  Eigen::VectorXd values_;
  Eigen::MatrixXd covariance_, formal_;
  OverlapResult result_;
};

}  // namespace

const char* nameOf(RadiometricTerm term) {
  return kTerms[static_cast<std::size_t>(term)].name;
}

const char* unitOf(RadiometricTerm term) {
  return kTerms[static_cast<std::size_t>(term)].unit;
}

double valueOf(RadiometricTerm term, const RadiometricModel& model) {
  return model.*kTerms[static_cast<std::size_t>(term)].value;
}

const char* nameOf(TermStatus status) {
  constexpr const char* kNames[] = {"fixed", "estimated", "not_estimable"};
  return kNames[static_cast<std::size_t>(status)];
}

std::vector<double> OverlapResult::gainFactors() const {
  std::vector<double> factors;
  factors.reserve(gains.size());
  for (const EstimatedTerm& gain : gains)
    factors.push_back(gain.status == TermStatus::estimated ? gain.value : 1.0);
  return factors;
}

bool OverlapResult::reliable() const {
  const auto lost = [](const EstimatedTerm& term) {
    return term.status == TermStatus::not_estimable;
  };
  return converged && std::none_of(terms.begin(), terms.end(), lost) &&
         std::none_of(gains.begin(), gains.end(), lost);
}

OverlapResult adjustOverlaps(const std::vector<SharedCell>& cells, double cell_size,
                             const std::vector<std::string>& strips, const RadiometricModel& model,
                             const OverlapSettings& settings) {
  model.check();
  OverlapResult result = Adjustment(cells, cell_size, strips, model, settings).run();
  result.before = variationOf(cells, nullptr, {});
  result.physics = variationOf(cells, &model, {});
  result.after = variationOf(cells, &result.model, result.gainFactors());
  return result;
}

std::string notEstimable(const OverlapResult& overlaps, const std::vector<std::string>& strips) {
  std::string names;
  forEachTerm(overlaps, strips, [&names](const std::string& name, const EstimatedTerm& term) {
    if (term.status != TermStatus::not_estimable) return;
    names += (names.empty() ? "" : ", ") + name;
  });
  return names.empty() ? "the adjustment did not converge" : names;
}

}  // namespace pcl_als
