// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "shared_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "smooth_basis.h"

namespace pcl_als {
namespace {

constexpr double kNodeSpacing = 0.25;  // correlation times, between nodes of the smooth component

// A priori standard deviations of differences to the first system, metres and radians: they limit
// what nothing determines.
constexpr double kLength = 1.0, kAngle = 0.5 * kRadiansPerDegree, kScale = 2e-3;
constexpr std::array<double, kSystemUnknownCount> kDifferences{
    kLength, kLength, kLength, kAngle, kAngle, kAngle, kLength, kScale, kLength, kLength, kLength};

// Places of the smooth and the constant components in VarianceFactors::values(), and the kind of
// an unknown: position, roll and pitch, heading.
constexpr int kSmooth = 3, kConstant = 6;
int kindOf(int unknown) {
  constexpr std::array<int, SharedErrors::kPerKnot> kKinds{0, 0, 0, 1, 1, 2};
  return kKinds[static_cast<std::size_t>(unknown % SharedErrors::kPerKnot)];
}

}  // namespace

int SharedErrors::StripKnots::before(double step) const {
  const auto after = std::upper_bound(at.begin(), at.end(), step,
                                      [](double value, int knot) { return value < knot; });
  return std::max(0, static_cast<int>(after - at.begin()) - 1);
}

SharedErrors::StripKnots SharedErrors::knotsOf(const TimeSpan& span, double spacing,
                                               const std::vector<TimeSpan>* observed) {
  constexpr double kMostSteps = 1e9;
  StripKnots strip;
  const double length = std::max(0.0, span.second - span.first);
  strip.start = span.first;
  strip.steps = static_cast<int>(std::min(kMostSteps, std::ceil(length / spacing - 1e-9)));
  strip.spacing = strip.steps > 0 ? length / strip.steps : 1.0;
  if (observed == nullptr || strip.steps == 0) {
    strip.at.resize(static_cast<std::size_t>(strip.steps) + (observed == nullptr ? 1 : 0));
    std::iota(strip.at.begin(), strip.at.end(), 0);
  } else {
    const auto stepOf = [&](double time) {
      return static_cast<int>(
          std::clamp((time - strip.start) / strip.spacing, 0.0, strip.steps - 1.0));
    };
    for (const auto& [from, to] : *observed)
      for (int step = stepOf(from); step <= stepOf(to) + 1; ++step) strip.at.push_back(step);
    std::sort(strip.at.begin(), strip.at.end());
    strip.at.erase(std::unique(strip.at.begin(), strip.at.end()), strip.at.end());
  }
  if (strip.at.empty()) strip.at.push_back(0);
  return strip;
}

namespace {

/// Times of a pass, of all its strips.
struct Pass {
  TimeSpan span;
  std::vector<TimeSpan> observed;
};

/// The strips of each pass together; \a index: the pass of each strip.
std::vector<Pass> passesOf(const std::vector<TimeSpan>& spans,
                           const std::vector<std::vector<TimeSpan>>& observed,
                           const std::vector<int>& first_strip, std::vector<int>& index) {
  std::vector<Pass> passes;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const std::size_t first = first_strip.empty() ? i : static_cast<std::size_t>(first_strip[i]);
    const bool is_new = first == i;
    index.push_back(is_new ? static_cast<int>(passes.size()) : index[first]);
    if (is_new) passes.push_back({spans[i], {}});
    Pass& pass = passes[static_cast<std::size_t>(index[i])];
    // A strip that is excluded has no times.
    if (pass.span.first == pass.span.second) pass.span = spans[i];
    if (spans[i].first != spans[i].second) {
      pass.span = {std::min(pass.span.first, spans[i].first),
                   std::max(pass.span.second, spans[i].second)};
    }
    if (!observed.empty())
      pass.observed.insert(pass.observed.end(), observed[i].begin(), observed[i].end());
  }
  return passes;
}

}  // namespace

SharedErrors::SharedErrors(const std::vector<TimeSpan>& spans, const SharedErrorModel& model,
                           const std::vector<std::vector<TimeSpan>>& observed,
                           const StripSystems& systems)
    : systems_(systems), model_(model) {
  model_.validate();
  std::array<double, kSystemUnknownCount> own{};
  for (const SystemParameter p : systems_.own.parameters)
    own[static_cast<std::size_t>(indexOf(p))] = kDifferences[static_cast<std::size_t>(indexOf(p))];
  for (std::size_t i = kSystemParameterCount; i < own.size() && systems_.own.offset; ++i)
    own[i] = kDifferences[i];
  own_.assign(static_cast<std::size_t>(systems_.count - 1), own);
  for (std::size_t i = 0; i < systems_.held.size(); ++i)
    own_[static_cast<std::size_t>(systems_.heldSystem(i)) - 1].fill(0.0);
  for (const Pass& pass : passesOf(spans, observed, systems_.pass, pass_)) {
    strips_.push_back(
        knotsOf(pass.span, model_.knot_spacing, observed.empty() ? nullptr : &pass.observed));
    strips_.back().first = knot_count_;
    knot_count_ += static_cast<int>(strips_.back().at.size());
  }
  for (StripKnots& strip : strips_) addCoefficients(strip);
  assembleGaussMarkov();
}

void SharedErrors::addCoefficients(StripKnots& strip) {
  strip.per_node = kNodeSpacing * model_.correlation_time / strip.spacing;
  for (const int step : strip.at) {
    const int node = static_cast<int>(std::floor(step / strip.per_node));
    for (int i = node - 1; i <= node + 2; ++i) {
      if (strip.nodes.empty() || strip.nodes.back() < i) strip.nodes.push_back(i);
    }
  }
  strip.first_node = systemBlock(systems_.count) + coefficient_count_;
  strip.constant = strip.first_node + static_cast<int>(strip.nodes.size());
  coefficient_count_ += static_cast<int>(strip.nodes.size()) + 1;
}

SharedErrors::Weights SharedErrors::coefficientsAt(const StripKnots& strip, int step) const {
  Weights weights{{strip.constant, 1.0}};
  const double place = step / strip.per_node;
  const int first = static_cast<int>(std::floor(place)) - 1;
  const auto from = std::lower_bound(strip.nodes.begin(), strip.nodes.end(), first);
  for (auto node = from; node != strip.nodes.end() && *node < first + 4; ++node) {
    weights.emplace_back(strip.first_node + static_cast<int>(node - strip.nodes.begin()),
                         cubicBSpline(place - *node) / std::sqrt(kMeanSquare));
  }
  return weights;
}

void SharedErrors::assembleGaussMarkov() {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < unknowns(); ++i) entries.emplace_back(i, i, 0.0);
  for (const StripKnots& strip : strips_) {
    // The Gauss-Markov component at a knot, the error there less the other components, is rho times
    // that at the knot before, with variance 1 - rho^2.
    Weights before;
    for (std::size_t k = 0; k < strip.at.size(); ++k) {
      Weights here{{strip.first + static_cast<int>(k), 1.0}};
      for (const auto& [block, weight] : coefficientsAt(strip, strip.at[k]))
        here.emplace_back(block, -weight);
      const double seconds = k > 0 ? strip.spacing * (strip.at[k] - strip.at[k - 1]) : 0.0;
      const double rho = k > 0 ? std::exp(-seconds / model_.correlation_time) : 0.0;
      Weights change = here;
      for (const auto& [block, weight] : before) change.emplace_back(block, -rho * weight);
      const double variance = 1.0 - rho * rho;
      gauss_markov_log_ -= kPerKnot * std::log(variance);
      for (const auto& [row, a] : change) {
        for (const auto& [column, b] : change) {
          for (int i = 0; i < kPerKnot; ++i)
            entries.emplace_back(row * kPerKnot + i, column * kPerKnot + i, a * b / variance);
        }
      }
      before = std::move(here);
    }
  }
  gauss_markov_.resize(unknowns(), unknowns());
  gauss_markov_.setFromTriplets(entries.begin(), entries.end());
}

const SharedErrors::StripKnots& SharedErrors::passOf(int strip) const {
  return strips_[static_cast<std::size_t>(pass_[static_cast<std::size_t>(strip)])];
}

bool SharedErrors::isOwn(int system, int unknown) const {
  return own_[static_cast<std::size_t>(system - 1)][static_cast<std::size_t>(unknown)] > 0.0;
}

void SharedErrors::setOwn(int system, int unknown, double std) {
  own_[static_cast<std::size_t>(system - 1)][static_cast<std::size_t>(unknown)] = std;
}

void SharedErrors::share(int system, int unknown) {
  setOwn(system, unknown, 0.0);
}

std::vector<double> SharedErrors::systemVariances() const {
  constexpr double kShared = 1e-6;  // of what differences may be at most
  std::vector<double> variances;
  for (const auto& own : own_) {
    for (int i = 0; i < kSystemBlocks * kPerKnot; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double std = i >= kSystemUnknownCount ? 1.0
                         : own[k] > 0.0           ? own[k]
                                                  : kShared * kDifferences[k];
      variances.push_back(std * std);
    }
  }
  for (std::size_t i = 0; i < systems_.held.size(); ++i) {
    constexpr std::size_t kUp = kSystemUnknownCount - 1;
    const std::size_t block =
        (static_cast<std::size_t>(systems_.heldSystem(i)) - 1) * kSystemBlocks * kPerKnot;
    const double std = std::max(systems_.held[i].offset, kShared);
    const double plan = std::max(systems_.held[i].plan, kShared);
    variances[block + kUp] = std * std;
    variances[block + kUp - 1] = variances[block + kUp - 2] = plan * plan;
  }
  return variances;
}

double SharedErrors::shiftScale(int strip) const {
  const int held = systems_.heldIndex(strip);
  const double own = held < 0 ? 0.0 : systems_.held[static_cast<std::size_t>(held)].local;
  return own > 0.0 ? own / model_.local : 1.0;
}

SharedErrors::Place SharedErrors::placeOf(int index, double time) const {
  const StripKnots& strip = passOf(index);
  if (strip.at.size() == 1) return {strip.first, strip.first, 0.0};
  const double step =
      std::clamp((time - strip.start) / strip.spacing, static_cast<double>(strip.at.front()),
                 static_cast<double>(strip.at.back()));
  const int knot = std::min(strip.before(step), static_cast<int>(strip.at.size()) - 2);
  const double from = strip.at[knot], to = strip.at[knot + 1];
  return {strip.first + knot, strip.first + knot + 1, (step - from) / (to - from)};
}

SharedErrors::Variances SharedErrors::shareOf(double share,
                                              const VarianceFactors::Trajectory& levels) const {
  const double position = share * model_.position * model_.position * levels.position;
  const double roll_pitch = share * model_.roll_pitch * model_.roll_pitch * levels.roll_pitch;
  const double heading = share * model_.heading * model_.heading * levels.heading;
  return {position, position, position, roll_pitch, roll_pitch, heading};
}

SharedErrors::PriorVariances SharedErrors::priorVariances(const VarianceFactors& levels) const {
  std::array<double, kInstrumentBlocks * kPerKnot> instrument;
  constexpr double kAbsent = 1e-6;  // of the prior's standard deviation, where it must not be zero
  instrument.fill(1.0);             // of unknowns without effect
  for (const ErrorSourceInfo& info : errorSources()) {
    const auto i = static_cast<std::size_t>(indexOf(info.source));
    const SharedErrorModel::SourcePrior& prior = model_.sources[i];
    // Observations may have been formed with the effects of sources that are no longer considered.
    const double std =
        isConsidered(info.source) ? prior.std : std::max(prior.std_absent, kAbsent * prior.std);
    instrument[i] = std * std;
  }
  return {shareOf(1.0 - model_.smooth_share - model_.constant_share, levels.gauss_markov),
          shareOf(model_.smooth_share, levels.smooth),
          shareOf(model_.constant_share, levels.constant), instrument, systemVariances()};
}

bool SharedErrors::isConsidered(ErrorSource source) const {
  return std::find(considered_.begin(), considered_.end(), source) != considered_.end();
}

int SharedErrors::observedInstrumentBlocks() const {
  const bool second = std::any_of(considered_.begin(), considered_.end(),
                                  [](ErrorSource source) { return indexOf(source) >= kPerKnot; });
  return second ? 2 : 1;
}

SharedErrors::Variances SharedErrors::variances(const VarianceFactors& levels) const {
  const PriorVariances prior = priorVariances(levels);
  Variances sum{};
  for (int i = 0; i < kPerKnot; ++i)
    sum[i] = prior.gauss_markov[i] + prior.smooth[i] + prior.constant[i];
  return sum;
}

void SharedErrors::setVarianceFactor(int strip, int component, double factor) {
  const auto pass = static_cast<std::size_t>(pass_[static_cast<std::size_t>(strip)]);
  strips_[pass].variance_factors[static_cast<std::size_t>(component)] = factor;
}

SharedErrors::PriorDiagonals SharedErrors::priorDiagonals(const VarianceFactors& levels) const {
  const PriorVariances prior = priorVariances(levels);
  PriorDiagonals diagonals{Eigen::VectorXd::Zero(unknowns()), Eigen::VectorXd::Zero(unknowns())};
  const auto add = [](Eigen::VectorXd& information, int block, const Variances& variances,
                      const Variances& factors) {
    for (int i = 0; i < kPerKnot; ++i)
      information[block * kPerKnot + i] = 1.0 / (variances[i] * factors[i]);
  };
  for (std::size_t i = 0; i < prior.instrument.size(); ++i)
    diagonals.own[instrumentBlock() * kPerKnot + static_cast<int>(i)] = 1.0 / prior.instrument[i];
  for (std::size_t i = 0; i < prior.systems.size(); ++i)
    diagonals.own[systemBlock(1) * kPerKnot + static_cast<int>(i)] = 1.0 / prior.systems[i];
  for (const StripKnots& strip : strips_) {
    const Variances& factors = strip.variance_factors;
    for (std::size_t k = 0; k < strip.at.size(); ++k)
      add(diagonals.gauss_markov, strip.first + static_cast<int>(k), prior.gauss_markov, factors);
    for (int node = strip.first_node; node <= strip.constant; ++node) {
      add(diagonals.gauss_markov, node, prior.gauss_markov, factors);
      add(diagonals.own, node, node < strip.constant ? prior.smooth : prior.constant, factors);
    }
  }
  return diagonals;
}

Eigen::SparseMatrix<double> SharedErrors::priorInformation(const VarianceFactors& levels) const {
  const PriorDiagonals diagonals = priorDiagonals(levels);
  Eigen::SparseMatrix<double> information = gauss_markov_;
  for (Eigen::Index column = 0; column < information.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(information, column); entry; ++entry)
      entry.valueRef() = entry.value() * diagonals.gauss_markov[column] +
                         (entry.row() == column ? diagonals.own[column] : 0.0);
  }
  return information;
}

std::vector<Eigen::SparseMatrix<double>> SharedErrors::priorParts(
    const VarianceFactors& levels) const {
  const PriorDiagonals diagonals = priorDiagonals(levels);
  std::vector<std::vector<Eigen::Triplet<double>>> entries(kTrajectoryComponents);
  for (int column = 0; column < unknowns(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(gauss_markov_, column); entry; ++entry)
      entries[kindOf(column)].emplace_back(entry.row(), column,
                                           entry.value() * diagonals.gauss_markov[column]);
  }
  for (const StripKnots& strip : strips_) {
    for (int i = strip.first_node * kPerKnot; i < (strip.constant + 1) * kPerKnot; ++i) {
      const int component = kindOf(i) + (i < strip.constant * kPerKnot ? kSmooth : kConstant);
      entries[component].emplace_back(i, i, diagonals.own[i]);
    }
  }
  std::vector<Eigen::SparseMatrix<double>> parts;
  for (const auto& part : entries) {
    parts.emplace_back(unknowns(), unknowns());
    parts.back().setFromTriplets(part.begin(), part.end());
  }
  return parts;
}

Eigen::VectorXd SharedErrors::priorVariables() const {
  const auto strips = static_cast<double>(strips_.size());
  Eigen::VectorXd count(kTrajectoryComponents);
  const Eigen::Vector3d axes(3.0, 2.0, 1.0);  // position, roll and pitch, heading
  count << knot_count_ * axes, (coefficient_count_ - strips) * axes, strips * axes;
  return count;
}

Eigen::MatrixXd SharedErrors::contributions(const Eigen::VectorXd& solution) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(observedUnknowns(), kTrajectoryComponents);
  for (const StripKnots& strip : strips_) {
    for (std::size_t k = 0; k < strip.at.size(); ++k) {
      const int knot = (strip.first + static_cast<int>(k)) * kPerKnot;
      for (int i = 0; i < kPerKnot; ++i) sum(knot + i, kindOf(i)) = solution[knot + i];
      for (const auto& [block, weight] : coefficientsAt(strip, strip.at[k])) {
        const int component = block < strip.constant ? kSmooth : kConstant;
        for (int i = 0; i < kPerKnot; ++i) {
          const double part = weight * solution[block * kPerKnot + i];
          sum(knot + i, kindOf(i) + component) += part;
          sum(knot + i, kindOf(i)) -= part;
        }
      }
    }
  }
  return sum;
}

double SharedErrors::priorLogDeterminant(const VarianceFactors& levels) const {
  const PriorVariances prior = priorVariances(levels);
  const auto logOf = [](const auto& variances) {
    double sum = 0.0;
    for (const double variance : variances) sum += std::log(variance);
    return sum;
  };
  const auto strips = static_cast<double>(strips_.size());
  double factors = 0.0;
  for (const StripKnots& strip : strips_) {
    const std::size_t blocks = strip.at.size() + strip.nodes.size() + 1;
    factors += static_cast<double>(blocks) * logOf(strip.variance_factors);
  }
  return gauss_markov_log_ - factors - knot_count_ * logOf(prior.gauss_markov) -
         logOf(prior.instrument) - logOf(prior.systems) - strips * logOf(prior.constant) -
         (coefficient_count_ - strips) * logOf(prior.smooth);
}

}  // namespace pcl_als
