// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "group_differences.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

#include "block_solution.h"
#include "error_diagnosis.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

constexpr double kSession = 3.0 * 3600.0;  // seconds without a strip between two sessions
constexpr double kOffset = 0.1;            // metres: standard deviation of an offset, each axis
constexpr double kPriorFreedom = 4.0;      // degrees of freedom that the prior contributes

/// By strip, its session from 1; 0 where it is not used.
std::vector<int> sessionsOf(const std::vector<TimeSpan>& times) {
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return times[a].first < times[b].first; });
  std::vector<int> sessions(times.size(), 0);
  int session = 0;
  double last = 0.0;
  for (const std::size_t i : order) {
    if (times[i].first == times[i].second) continue;
    if (session == 0 || times[i].first - last > kSession) ++session;
    last = session == 1 && last == 0.0 ? times[i].second : std::max(last, times[i].second);
    sessions[i] = session;
  }
  return sessions;
}

/// By strip, "channel1" by its id, or "scanner2" by its place among the strips of its pass; empty:
/// the strip is not told apart.
std::vector<std::string> scannersOf(const std::vector<std::string>& ids,
                                    const std::vector<int>& sessions,
                                    const std::vector<int>& passes) {
  constexpr std::size_t kMostScanners = 4;
  std::vector<std::string> names;
  for (const std::string& id : ids) {
    const std::string channel = id.substr(passOfStrip(id).size());  // ".ch1"
    names.push_back(channel.empty() ? "" : "channel" + channel.substr(3));
  }
  std::map<int, std::vector<std::size_t>> strips_of;
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (sessions[i] > 0) strips_of[passes[i]].push_back(i);
  const bool divided = !std::all_of(names.begin(), names.end(), std::mem_fn(&std::string::empty));
  const std::size_t count = strips_of.empty() ? 0 : strips_of.begin()->second.size();
  const bool alike = std::all_of(strips_of.begin(), strips_of.end(),
                                 [&](const auto& pass) { return pass.second.size() == count; });
  if (divided || !alike || count < 2 || count > kMostScanners) return names;
  for (const auto& [pass, strips] : strips_of)
    for (std::size_t k = 0; k < count; ++k) names[strips[k]] = "scanner" + std::to_string(k + 1);
  return names;
}

std::string remedyOf(const DifferenceUnknown& unknown, const std::string& group) {
  const auto is = [&](const char* word) { return group.find(word) != std::string::npos; };
  if (unknown.index >= kSystemParameterCount)
    return "check base station, antenna height, datum and geoid of this session; or calibrate it "
           "as a system of its own, with an offset of the coordinates";
  if (is("session"))
    return "mounting or instrument changed between the sessions: calibrate them as systems of "
           "their own";
  if (is("scanned"))
    return "check how the scan angles of both directions were derived (lag of the mirror, time "
           "tags of the encoder)";
  return is("channel")   ? "calibrate the channels as systems of their own"
         : is("scanner") ? "calibrate the strips of each scanner as a system of its own"
                         : "calibrate the points of each value as systems of their own";
}

/// "user data 1" of user_data1.
std::string readable(std::string name) {
  const std::size_t digit = name.find_first_of("0123456789");
  if (digit != std::string::npos) name.insert(digit, " ");
  for (const std::string scanner : {"_channel", "_scanner"}) {
    const std::size_t next = name.find(scanner);
    if (next != std::string::npos) name.insert(next + scanner.size(), " ");
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

SpikeAndSlab mixtureOf(const std::vector<DifferenceUnknown>& unknowns,
                       const Adjustment::SystemPosterior& posterior, double freedom) {
  const auto n = static_cast<Eigen::Index>(unknowns.size());
  Eigen::VectorXd mean(n);
  Eigen::MatrixXd covariance(n, n);
  std::vector<SpikeAndSlab::Prior> priors;
  SpikeAndSlab::Certainty certainty{1.0, freedom};
  for (Eigen::Index i = 0; i < n; ++i) {
    const DifferenceUnknown& row = unknowns[static_cast<std::size_t>(i)];
    mean[i] = posterior.mean[row.index];
    for (Eigen::Index j = 0; j < n; ++j)
      covariance(i, j) =
          posterior.covariance(row.index, unknowns[static_cast<std::size_t>(j)].index);
    priors.push_back({kDifferenceAbsent, 0.0, row.slab * row.slab});
    if (std::sqrt(covariance(i, i)) < SharedErrorModel::kDetermined * row.slab)
      certainty.overdispersion =
          std::max(certainty.overdispersion, posterior.scatter[row.index] / covariance(i, i));
  }
  return {priors, mean, covariance, certainty};
}

bool isSession(const StripGroup& group) {
  return group.name.find("session") != std::string::npos;
}

}  // namespace

std::vector<DifferenceUnknown> differenceUnknowns(bool offsets) {
  std::vector<DifferenceUnknown> unknowns;
  for (const P p : {P::boresight_pitch, P::boresight_roll, P::boresight_heading, P::range_bias,
                    P::scan_angle_scale}) {
    const SystemParameterInfo& info = infoOf(p);
    std::string title(info.name);
    std::replace(title.begin(), title.end(), '_', ' ');
    unknowns.push_back({indexOf(p), std::string(info.name), title, std::string(info.unit),
                        info.internal_per_unit, slabOf(p)});
  }
  if (!offsets) return unknowns;
  const char* const names[] = {"east", "north", "up"};
  for (int i = 0; i < 3; ++i)
    unknowns.push_back({kSystemParameterCount + i, std::string("offset_") + names[i],
                        std::string("coordinates (") + names[i] + ")", "m", 1.0, kOffset});
  return unknowns;
}

ErrorFinding differenceFinding(const DifferenceUnknown& unknown, const SpikeAndSlab& mixture,
                               Eigen::Index at, const ScanGeometry& edge) {
  const double value = mixture.valueIfPresent()[at], std = mixture.stdIfPresent()[at];
  ErrorFinding finding;
  finding.unit = unknown.unit;
  finding.probability = mixture.presence()[at];
  finding.value = value / unknown.per_unit;
  finding.std = std / unknown.per_unit;
  finding.effect = unknown.index < kSystemParameterCount
                       ? (designBlock(edge).col(unknown.index) * value).norm()
                       : std::abs(value);
  finding.determined = SharedErrorModel::isDetermined(value, std, unknown.slab);
  finding.evidence = evidenceOf(finding);
  return finding;
}

std::vector<StripGroup> comparedGroups(const std::vector<std::string>& ids,
                                       const std::vector<TimeSpan>& times,
                                       const std::vector<int>& passes) {
  const std::vector<int> sessions = sessionsOf(times);
  const std::vector<std::string> scanners = scannersOf(ids, sessions, passes);
  std::map<std::pair<int, std::string>, std::vector<std::string>> parts;
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (sessions[i] > 0) parts[{sessions[i], scanners[i]}].push_back(ids[i]);
  if (parts.size() < 2) return {};
  const bool several = parts.begin()->first.first != parts.rbegin()->first.first;
  std::vector<StripGroup> groups;
  for (auto& [key, strips] : parts) {
    std::string name = several ? "session" + std::to_string(key.first) : "";
    if (!key.second.empty()) name += (name.empty() ? "" : "_") + key.second;
    groups.push_back({name, std::move(strips)});
  }
  return groups;
}

bool weighWithDifferences(const std::vector<StripGroup>& groups, const ParameterChoice& choice,
                          const std::vector<AreaObservations>& observations, int threads,
                          Adjustment& adjustment) {
  constexpr int kWeightings = 3;
  const SharedErrors common = adjustment.errors();
  const VarianceFactors levels = adjustment.levels();
  SharedErrors errors = common;
  for (std::size_t k = 1; k < groups.size(); ++k)
    for (const DifferenceUnknown& u : differenceUnknowns(isSession(groups[k])))
      errors.setOwn(static_cast<int>(k), u.index, u.slab);
  adjustment.setErrors(errors);
  adjustment.setVarianceFactors(levels);
  PairWeights weights;
  AdjustmentSolution solution = choice.solution;
  for (int i = 0; i < kWeightings; ++i) {
    const PairWeights::Residuals residuals =
        pairResiduals(observations, adjustment, solution, threads);
    weights.findScales(residuals, threads);
    weights.update(residuals, i > 0, threads);
    adjustment.accumulate(observations, weights.weights());
    solution = adjustment.solve(choice.estimate, choice.solution.biases);
    if (!solution.solved) return false;
  }
  adjustment.setErrors(common);
  adjustment.setVarianceFactors(levels);
  return true;
}

void addGroupDifferences(const std::vector<StripGroup>& groups, std::size_t strips,
                         const ScanGeometry& edge, const ParameterChoice& choice,
                         const Adjustment& adjustment, std::vector<ErrorFinding>& diagnosis) {
  const double freedom = std::max(
      1.0, kPriorFreedom + static_cast<double>(strips) - static_cast<double>(groups.size()));
  for (std::size_t k = 1; k < groups.size(); ++k) {
    const std::vector<DifferenceUnknown> unknowns = differenceUnknowns(isSession(groups[k]));
    const int system = static_cast<int>(k);
    SharedErrors errors = adjustment.errors();
    for (const DifferenceUnknown& u : unknowns) errors.setOwn(system, u.index, u.slab);
    Adjustment other = adjustment;
    other.setErrors(errors);
    other.setVarianceFactors(adjustment.levels());
    estimateLevels(other, choice.estimate, adjustment.levels());
    const AdjustmentSolution solution = other.solve(choice.estimate, choice.solution.biases);
    const SpikeAndSlab mixture = mixtureOf(
        unknowns, other.systemPosteriors({system}, choice.estimate, solution).front(), freedom);
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      const DifferenceUnknown& u = unknowns[i];
      ErrorFinding finding = differenceFinding(u, mixture, static_cast<Eigen::Index>(i), edge);
      finding.source = groups[k].name + "_" + u.name;
      finding.title =
          u.title + " of " + readable(groups[k].name) + " against " + readable(groups.front().name);
      finding.hint = remedyOf(u, groups[k].name);
      if (!solution.solved) {
        finding.determined = false;
        finding.evidence = evidenceOf(finding);
      }
      diagnosis.push_back(std::move(finding));
    }
  }
}

void judgeDifferences(std::size_t first, double relevant, Hint hint, CalibrationResult& result) {
  for (std::size_t i = first; i < result.diagnosis.size(); ++i) {
    const ErrorFinding& f = result.diagnosis[i];
    if (!f.determined || f.probability <= kSupported) continue;
    char size[80];
    std::snprintf(size, sizeof size, " differs by %.3g +- %.2g %s", f.value, f.std, f.unit.c_str());
    const std::string text = f.source + ": " + f.title + size;
    result.warnings.emplace_back(text + "; " + f.hint, hint);
    if (f.source.find("offset_") == std::string::npos && f.effect > relevant)
      result.verdict.downgrade(CalibrationStatus::parameters_affected,
                               text + ", and no parameters of one system describe both");
  }
}

}  // namespace pcl_als
