// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_error_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parameter_text.h>

#include "angle_curve.h"
#include "error_diagnosis.h"

namespace pcl_als {
namespace {

/// Whether heights of the trajectory are wrong, and not scan angles by a factor that resembles it.
bool isCertain(const HeightError& error) {
  return error.kind == HeightError::Kind::offset || error.kind == HeightError::Kind::gross;
}

constexpr std::size_t kListed = 5;
constexpr double kSwath = 0.15;  // square of the scan angle at the edge of a swath of 45 degrees
constexpr double kNoticeableChange = 0.1;  // of a standard deviation: it grows by half a percent

struct Component {
  const char* name;
  bool angle;
  const char* measured;  ///< quantity whose a priori standard deviation a user states
  const char* causes;
};
constexpr const char* kPlanCauses = "datum, projection or reference point of the trajectory";
constexpr const char* kHeightCauses =
    "unit or vertical datum of the trajectory's heights, or its reference point";
constexpr const char* kAttitudeCauses = "attitude of the trajectory, its unit and its time";
constexpr const char* kPointCauses =
    "trajectory that the points were computed with, whose errors they contain";
constexpr std::array<Component, 6> kComponents{{
    {"east", false, "positions", kPlanCauses},
    {"north", false, "positions", kPlanCauses},
    {"height", false, "positions", kHeightCauses},
    {"pitch", true, "roll and pitch", kAttitudeCauses},
    {"roll", true, "roll and pitch", kAttitudeCauses},
    {"heading", true, "heading", kAttitudeCauses},
}};

std::string sizeText(double value, bool angle) {
  char text[48];
  if (angle) {
    std::snprintf(text, sizeof text, "%.0f arcsec", value / kRadiansPerArcsec);
  } else {
    std::snprintf(text, sizeof text, "%.0f mm", 1000.0 * value);
  }
  return text;
}

std::string describe(const StripErrorSize& error, bool reconstructed) {
  const Component& component = kComponents[static_cast<std::size_t>(error.component)];
  char ratio[32];
  std::snprintf(ratio, sizeof ratio, "%.1f", error.ratio());
  return "strip " + error.strip + ": trajectory correction in " + component.name + " of " +
         sizeText(error.rms, component.angle) + " (RMS over the strip), " + ratio +
         " times its a priori standard deviation of " + sizeText(error.sigma, component.angle) +
         "; check the " + (reconstructed ? kPointCauses : component.causes) +
         ", or state a larger standard deviation of its " + component.measured;
}

/// RMS over all pairs of strips.
double overall(const CalibrationResult& result, double PairFit::*rms) {
  double squares = 0.0, count = 0.0;
  for (const PairFit& pair : result.pairs) {
    const auto weight = static_cast<double>(pair.correspondences);
    squares += weight * pair.*rms * (pair.*rms);
    count += weight;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// "+0.0512 m", "-12.3 arcsec", "+0.00012"
std::string valueText(SystemParameter parameter, double value) {
  return (value < 0.0 ? "" : "+") + inUnit(parameter, value);
}

/// Names the affected parameters, largest change first, and sets their reasons; empty without any.
std::string affectedText(std::vector<PriorEffect> effects, CalibrationResult& result) {
  std::sort(effects.begin(), effects.end(), [](const PriorEffect& a, const PriorEffect& b) {
    return std::abs(a.change) * b.std > std::abs(b.change) * a.std;
  });
  std::string names;
  for (const PriorEffect& effect : effects) {
    if (!effect.affected()) continue;
    char text[160];
    if (std::isfinite(effect.std_enlarged)) {
      std::snprintf(text, sizeof text, "%s, %.1f standard deviations; standard deviation then %s",
                    valueText(effect.parameter, effect.change).c_str(),
                    std::abs(effect.change) / effect.std,
                    valueText(effect.parameter, effect.std_enlarged).c_str() + 1);
    } else {
      std::snprintf(text, sizeof text, "not determined then");
    }
    names += (names.empty() ? "" : ", ") + std::string(infoOf(effect.parameter).name) + " (" +
             text + ")";
    std::string& reason = result[effect.parameter].reason;
    reason += (reason.empty() ? "" : "; ") +
              std::string("affected by large trajectory corrections: ") + text;
  }
  if (names.empty()) return names;
  return "parameters that depend on these corrections, and what they change by if errors of this "
         "size are expected: " +
         names;
}

/// Small trajectory errors may be all that remains of a calibrated system; alone they are no
/// objection.
void assessNeed(bool corrections_are_large, CalibrationResult& result) {
  constexpr double kNoBetter = 0.98, kMuchBetter = 0.7;  // of the misfit as delivered
  const double before = overall(result, &PairFit::rms_before);
  const double after = overall(result, &PairFit::rms_after);
  const double strips = overall(result, &PairFit::rms_strips);
  if (after < kNoBetter * before || strips > kMuchBetter * before || strips <= 0.0) return;
  const std::string text =
      "only corrections of the trajectory make the strips agree (" + sizeText(before, false) +
      " as delivered, " + sizeText(after, false) + " with the biases, " + sizeText(strips, false) +
      " with strip corrections): the remaining misfit is not the effect of system biases";
  result.warnings.push_back(text);
  if (corrections_are_large) result.verdict.downgrade(CalibrationStatus::parameters_affected, text);
}

}  // namespace

std::vector<StripErrorSize> largeStripErrors(const std::vector<StripErrors>& strips,
                                             const SharedErrorModel& model, double ratio) {
  const std::array<double, 6> sigmas{model.position,   model.position,   model.position,
                                     model.roll_pitch, model.roll_pitch, model.heading};
  std::vector<StripErrorSize> large;
  for (const StripErrors& strip : strips) {
    Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
    for (const TrajectoryErrorKnot& knot : strip.knots) {
      squares.head<3>() += knot.position.cwiseAbs2();
      squares.tail<3>() += knot.angles.cwiseAbs2();
    }
    const double count = std::max<double>(1.0, static_cast<double>(strip.knots.size()));
    for (int i = 0; i < 6; ++i) {
      const StripErrorSize error{strip.id, i, std::sqrt(squares[i] / count),
                                 sigmas[static_cast<std::size_t>(i)]};
      if (error.ratio() > ratio) large.push_back(error);
    }
  }
  std::stable_sort(large.begin(), large.end(),
                   [](const auto& a, const auto& b) { return a.ratio() > b.ratio(); });
  return large;
}

namespace {

/// The source of a supported finding that one set of parameters does not describe: a difference
/// between parts of the block, or a curve of the scan angle. Empty: none.
std::string causeBesideParameters(const HeightError& height, const CalibrationResult& result) {
  if (isCertain(height)) return "the height of the trajectory";
  const auto is_difference = [](const std::string& source) {
    return std::any_of(systemParameters().begin(), systemParameters().end(),
                       [&](const SystemParameterInfo& info) {
                         const std::string end = "_" + std::string(info.name);
                         return source.size() > end.size() &&
                                source.compare(source.size() - end.size(), end.size(), end) == 0;
                       });
  };
  for (const ErrorFinding& f : result.diagnosis)
    if (f.determined && f.probability > kSupported &&
        (f.source == AngleCurve::kSource || is_difference(f.source)))
      return f.source;
  return {};
}

/// The largest correction, and the cause that is to be examined before those of trajectories.
std::string describeWithCause(const std::vector<StripErrorSize>& large, const std::string& cause) {
  const StripErrorSize& first = large.front();
  const Component& component = kComponents[static_cast<std::size_t>(first.component)];
  return counted(large.size(), "trajectory correction") + " beyond three a priori standard " +
         "deviations (largest: strip " + first.strip + ", " + component.name + ", " +
         sizeText(first.rms, component.angle) + "), of which " + cause +
         " may be the cause: examine it first";
}

void warnOfCorrections(const std::vector<StripErrorSize>& large, const std::string& cause,
                       bool reconstructed, CalibrationResult& result) {
  if (!cause.empty() && !large.empty()) {
    result.warnings.push_back(describeWithCause(large, cause));
    return;
  }
  for (std::size_t i = 0; i < std::min(kListed, large.size()); ++i)
    result.warnings.push_back({describe(large[i], reconstructed), Hint::flight_sigmas});
  if (large.size() > kListed)
    result.warnings.push_back(std::to_string(large.size() - kListed) +
                              " further trajectory corrections exceed three a priori standard "
                              "deviations");
}

}  // namespace

void assessStripErrors(const CalibrationSettings& settings, const std::vector<PriorEffect>& effects,
                       const HeightError& height, CalibrationResult& result) {
  const bool reconstructed = settings.reconstructed_height_std.has_value();
  const std::string cause = causeBesideParameters(height, result);
  const std::vector<StripErrorSize> large =
      largeStripErrors(result.strip_errors, settings.shared_errors, kNoticeableCorrection);
  warnOfCorrections(large, cause, reconstructed, result);
  const std::string affected = affectedText(effects, result);
  if (!affected.empty()) result.warnings.push_back(affected);
  if (!affected.empty() && large.front().ratio() > kContradictingCorrection) {
    result.verdict.downgrade(
        CalibrationStatus::parameters_affected,
        (cause.empty() ? describe(large.front(), reconstructed) : describeWithCause(large, cause)) +
            "; " + affected);
  }
  assessNeed(!affected.empty(), result);
}

namespace {

/// Parameters that depend on the height of the trajectory, with what they may be wrong by.
std::vector<std::pair<SystemParameter, double>> heightEffects(const HeightError& error,
                                                              const CalibrationResult& result) {
  using P = SystemParameter;
  const double share = std::abs(1.0 - 1.0 / error.slope);
  const auto estimated = [&](P p) { return result[p].status == ParameterStatus::estimated; };
  std::vector<std::pair<P, double>> effects;
  for (const auto& [arm, angle] : {std::pair(P::lever_arm_x, P::boresight_roll),
                                   std::pair(P::lever_arm_y, P::boresight_pitch)}) {
    const double bias = std::abs(result[angle].bias);
    if (estimated(arm)) {
      effects.emplace_back(arm, std::abs(error.metres) * bias);
    } else if (estimated(angle)) {
      effects.emplace_back(angle, share * bias);
    }
  }
  const double range = std::abs(result[P::range_bias].bias);
  const double height = std::abs(error.metres) / share;
  if (estimated(P::range_bias)) effects.emplace_back(P::range_bias, share * kSwath * range);
  if (estimated(P::scan_angle_scale)) {
    const double scale = std::abs(result[P::scan_angle_scale].bias);
    effects.emplace_back(P::scan_angle_scale, share * (scale + range / height));
  }
  return effects;
}

}  // namespace

void assessHeight(const HeightError& error, const CalibrationSettings& settings,
                  CalibrationResult& result) {
  const std::string trajectory =
      settings.reconstructed_height_std ? "the reconstructed trajectory" : "the trajectory";
  if (error.kind == HeightError::Kind::none) return;
  const bool certain = isCertain(error);
  if (certain) result.verdict.downgrade(CalibrationStatus::parameters_affected, error.text);
  std::string names;
  for (const auto& [parameter, change] : heightEffects(error, result)) {
    ParameterEstimate& p = result[parameter];
    if (!certain && !(change > kNoticeableChange * p.std)) continue;
    p.reason += p.reason.empty() ? "" : "; ";
    p.reason +=
        certain
            ? std::string(
                  "affected by the height of the trajectory, which is wrong: the standard "
                  "deviation does not include this")
            : "the standard deviation includes that the height of " + trajectory + " may be wrong";
    names += (names.empty() ? "" : ", ") + std::string(infoOf(parameter).name);
    if (!certain) p.std = std::hypot(p.std, change);
  }
  if (certain || names.empty()) return;
  result.warnings.push_back("the standard deviations of " + names + " include that the height of " +
                            trajectory + " may be wrong by " +
                            std::to_string(std::lround(std::abs(error.metres))) + " m");
}

HeightError uncertainHeight(double std, double height) {
  HeightError error;
  if (!(std > 0.0) || !(height > std)) return error;
  error.kind = HeightError::Kind::scale;
  error.metres = std;
  error.slope = height / (height - std);
  return error;
}

}  // namespace pcl_als
