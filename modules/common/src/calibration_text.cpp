// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The texts of a calibration for a terminal.
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als {
namespace {

using Parameters = std::array<ParameterEstimate, kSystemParameterCount>;

void shareOfPrior(const ParameterEstimate& estimate, std::ostream& out) {
  if (estimate.status == ParameterStatus::estimated)
    out << std::fixed << std::setprecision(0) << std::setw(9) << 100.0 * estimate.prior_share
        << " % |";
  else
    out << "          - |";
}

void parameterTable(const Parameters& parameters, std::ostream& out) {
  const bool with_prior =
      std::any_of(parameters.begin(), parameters.end(),
                  [](const ParameterEstimate& p) { return p.prior_share > 0.0; });
  out << "| parameter          |         bias |          std | formal std   | unit   |"
      << (with_prior ? " from prior |" : "") << '\n'
      << "|--------------------|--------------|--------------|--------------|--------|"
      << (with_prior ? "------------|" : "") << '\n';
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate =
        parameters[static_cast<std::size_t>(indexOf(info.parameter))];
    out << "| " << std::left << std::setw(18) << info.name << std::right << " | ";
    if (estimate.status == ParameterStatus::estimated) {
      out << std::fixed << std::setprecision(tableDecimals(info.parameter));
      for (const double value : {estimate.bias, estimate.std, estimate.std_formal}) {
        out << std::setw(12) << value / info.internal_per_unit << " | ";
      }
    } else {
      out << std::setw(12) << toString(estimate.status) << " |            - |            - | ";
    }
    out << std::left << std::setw(6) << info.unit << std::right << " |";
    if (with_prior) shareOfPrior(estimate, out);
    out << '\n';
  }
}

/// The parameters of a system after the first one that are its own.
void differenceTable(const SystemEstimate& system, const CalibrationResult& result,
                     std::ostream& out) {
  out << "| parameter          |         bias |          std |   difference |   std of it  | unit  "
         " "
         "|\n"
      << "|--------------------|--------------|--------------|--------------|--------------|-------"
         "-"
         "|\n";
  for (const SystemParameterInfo& info : systemParameters()) {
    const int i = indexOf(info.parameter);
    if (!(system.difference_std[i] > 0.0)) continue;
    const ParameterEstimate& p = system.parameters[static_cast<std::size_t>(i)];
    out << "| " << std::left << std::setw(18) << info.name << std::right << " | " << std::fixed
        << std::setprecision(tableDecimals(info.parameter));
    const double difference = p.bias - result[info.parameter].bias;
    for (const double value : {p.bias, p.std, difference, system.difference_std[i]})
      out << std::setw(12) << value / info.internal_per_unit << " | ";
    out << std::left << std::setw(6) << info.unit << std::right << " |\n";
  }
}

/// The components of the offset that are the system's own; a standard deviation of zero: it shares
/// that of the first one, because the data do not determine the difference.
void offsetLine(const SystemEstimate& system, std::ostream& out) {
  if (system.offset_std.isZero(0.0)) return;
  constexpr std::array<const char*, 3> kAxes{"east", "north", "up"};
  std::vector<std::string> shared;
  out << std::fixed << std::setprecision(4)
      << "\nOffset of its coordinates to those of the first system (m): ";
  const char* separator = "";
  for (int i = 0; i < 3; ++i) {
    if (system.offset_std[i] > 0.0) {
      out << separator << kAxes[i] << ' ' << system.offset[i] << " +- " << system.offset_std[i];
      separator = ", ";
    } else {
      shared.emplace_back(kAxes[i]);
    }
  }
  out << (shared.empty() ? "" : "; not determined: " + joined(shared)) << '\n';
}

/// Biases of every system where there are several.
void systemTables(const CalibrationResult& result, std::ostream& out) {
  for (const SystemEstimate& system : result.systems) {
    const bool first = &system == &result.systems.front();
    out << (first ? "" : "\n") << "System " << system.group.name << " (strips "
        << joined(system.group.strips) << "): biases (assumed - true)"
        << (first ? "" : ", differences to system " + result.systems.front().group.name) << "\n\n";
    if (first)
      parameterTable(system.parameters, out);
    else if (!system.difference_std.isZero(0.0))
      differenceTable(system, result, out);
    offsetLine(system, out);
  }
}

/// What the shares of the prior are.
void priorLine(const CalibrationResult& result, std::ostream& out) {
  if (!result.prior.any()) return;
  out << "\nFrom prior: the part of the variance of an estimate that stems from the prior"
      << (result.prior.source.empty() ? "" : " of " + result.prior.source)
      << "; the rest stems from this flight.\n";
}

void pairTable(const CalibrationResult& result, std::ostream& out) {
  const bool looks = std::any_of(result.pairs.begin(), result.pairs.end(),
                                 [](const PairFit& pair) { return pair.a == pair.b; });
  out << "\nNormal distances of point-patch pairs between strips (m; mean: first above second; "
         "strips: with strip corrections"
      << (looks ? "; of a strip with itself: points ahead of the sensor above those behind it" : "")
      << ")\n\n"
      << "| strips          |   pairs | rms before | after  | strips | mean before | after   | "
         "strips "
         " |\n"
      << "|-----------------|---------|------------|--------|--------|-------------|---------|-----"
         "---"
         "-|\n";
  out << std::fixed;
  for (const PairFit& pair : result.pairs) {
    out << "| " << std::left << std::setw(15) << (pair.a + " : " + pair.b) << std::right << " | "
        << std::setw(7) << pair.correspondences << " | " << std::setprecision(4) << std::setw(10)
        << pair.rms_before << " | " << std::setw(6) << pair.rms_after << " | " << std::setw(6)
        << pair.rms_strips << " | " << std::showpos << std::setw(11) << pair.mean_before << " | "
        << std::setw(7) << pair.mean_after << " | " << std::setw(7) << pair.mean_strips
        << std::noshowpos << " |\n";
  }
}

void controlTable(const CalibrationResult& result, std::ostream& out) {
  if (result.control.empty()) return;
  out << "\nHeights of strips above control (m)\n\n"
      << "| strip           |  points | rms before | after  | mean before | after   |\n"
      << "|-----------------|---------|------------|--------|-------------|---------|\n";
  for (const ControlFit& fit : result.control) {
    out << "| " << std::left << std::setw(15) << fit.strip << std::right << " | " << std::setw(7)
        << fit.points << " | " << std::setprecision(4) << std::setw(10) << fit.rms_before << " | "
        << std::setw(6) << fit.rms_after << " | " << std::showpos << std::setw(11)
        << fit.mean_before << " | " << std::setw(7) << fit.mean_after << std::noshowpos << " |\n";
  }
}

/// The mean places of the targets in the strips.
void targetTable(const CalibrationResult& result, std::ostream& out) {
  const auto in_plan = [](const ControlPointFit& fit) { return fit.isInPlan(); };
  if (std::none_of(result.control_points.begin(), result.control_points.end(), in_plan)) return;
  out << "\nTargets in the strips to the east and north of the surveyed ones (m)\n\n"
      << "| target          | axis  | strips |  before |   after | expected std | used |\n"
      << "|-----------------|-------|--------|---------|---------|--------------|------|\n";
  for (const ControlPointFit& fit : result.control_points) {
    if (!fit.isInPlan()) continue;
    out << "| " << std::left << std::setw(15) << fit.id << " | " << std::setw(5) << fit.component
        << std::right << " | " << std::setw(6) << fit.strips << " | " << std::setprecision(4)
        << std::showpos << std::setw(7) << fit.before << " | " << std::setw(7) << fit.after
        << std::noshowpos << " | " << std::setw(12) << fit.expected_std << " | "
        << (fit.used ? "yes " : "no  ") << " |\n";
  }
}

/// What was held fixed, with the fit of the strips to it.
void heldTable(const CalibrationResult& result, std::ostream& out) {
  if (result.held.empty()) return;
  out << "\nHeld fixed: normal distances of strips above it, and its height above the rest of the "
         "block if that were not known (m)\n\n"
      << "| surface              |   pairs | rms before | after  | mean before | after   |  height "
         "|     std |\n"
      << "|----------------------|---------|------------|--------|-------------|---------|---------"
         "|---------|\n";
  for (const FixedSurface& s : result.held) {
    out << "| " << std::left << std::setw(20) << s.name << std::right << " | " << std::setw(7)
        << s.correspondences << " | " << std::setprecision(4) << std::setw(10) << s.rms_before
        << " | " << std::setw(6) << s.rms_after << " | " << std::showpos << std::setw(11)
        << s.mean_before << " | " << std::setw(7) << s.mean_after << " | " << std::setw(7);
    if (s.offset_determined)
      out << s.offset << std::noshowpos << " | " << std::setw(7) << s.offset_std << " |\n";
    else
      out << '-' << std::noshowpos << " | " << std::setw(7) << '-' << " |\n";
  }
  for (const FixedSurface& s : result.held) {
    if (!s.strips.empty())
      out << "\nStrips " << joined(s.strips) << " were held fixed and are not corrected.\n";
    if (!s.offset_determined && s.correspondences > 0)
      out << "\nOnly " << s.name << " determines the height of the block: an error of its height "
          << "is one of range_bias.\n";
  }
}

/// Mean and RMS over a strip's knots of what its trajectory was found to be wrong by.
void stripTable(const CalibrationResult& result, std::ostream& out) {
  if (result.strip_errors.empty()) return;
  out << "\nErrors of the trajectory by strip, mean and RMS over time (mm; arcsec)\n\n"
      << "| strip           |      east |     north |        up |     pitch |      roll |   "
         "heading "
         "|\n"
      << "|-----------------|-----------|-----------|-----------|-----------|-----------|----------"
         "-"
         "|\n";
  for (const StripErrors& strip : result.strip_errors) {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero(), squares = sum;
    for (const TrajectoryErrorKnot& knot : strip.knots) {
      Eigen::Matrix<double, 6, 1> errors;
      errors << 1e3 * knot.position, knot.angles / kRadiansPerArcsec;
      sum += errors;
      squares += errors.cwiseAbs2();
    }
    const double count = static_cast<double>(strip.knots.size());
    out << "| " << std::left << std::setw(15) << strip.id << std::right << std::fixed
        << std::setprecision(1);
    for (int i = 0; i < 6; ++i) {
      out << " | " << std::showpos << std::setw(5) << sum[i] / count << std::noshowpos << ' '
          << std::setw(3) << std::setprecision(0) << std::sqrt(squares[i] / count)
          << std::setprecision(1);
    }
    out << " |\n";
  }
}

void largeCorrectionList(const CalibrationResult& result, std::ostream& out) {
  if (result.large_corrections.empty()) return;
  out << "\nLargest errors of the trajectory, beyond ordinary ones\n\n";
  int number = 0;
  for (const LargeCorrection& correction : result.large_corrections)
    out << ++number << ". " << describe(correction) << '\n';
}

/// The hint of an error that is probably present, by name.
void remedies(const CalibrationResult& result, std::ostringstream& out) {
  for (const ErrorFinding& finding : result.diagnosis) {
    if (finding.probability <= 0.5 || !finding.determined) continue;
    out << "- " << finding.source
        << (finding.probability > 0.9 ? ": " : " (possible, not certain): ") << finding.hint
        << (finding.corrected ? "; the correction of points removes it\n" : "\n");
  }
}

void diagnosisTable(const CalibrationResult& result, std::ostringstream& out) {
  if (result.diagnosis.empty()) return;
  std::size_t width = 20;
  for (const ErrorFinding& f : result.diagnosis) width = std::max(width, f.source.size());
  out << "\nDiagnosis: probability of each error, its size, and its effect at the edge of the "
         "swath\n\n| error"
      << std::string(width - 5, ' ')
      << " | probability |        value |          std | unit   | effect mm |\n|"
      << std::string(width + 2, '-')
      << "|-------------|--------------|--------------|--------|-----------|\n";
  for (const ErrorFinding& f : result.diagnosis) {
    out << "| " << std::left << std::setw(static_cast<int>(width)) << f.source << " | "
        << std::right << std::fixed << std::setprecision(3) << std::setw(11);
    if (!f.determined) {
      out << "not determ."
          << " | " << std::setw(12) << '-' << " | " << std::setw(12) << '-' << " | " << std::left
          << std::setw(6) << f.unit << " | " << std::right << std::setw(9) << '-';
    } else {
      out << f.probability << " | " << std::defaultfloat << std::setprecision(3) << std::setw(12)
          << f.value << " | " << std::setw(12) << f.std << " | " << std::left << std::setw(6)
          << f.unit << " | " << std::right << std::fixed << std::setprecision(1) << std::setw(9)
          << 1000.0 * f.effect;
    }
    out << " |\n";
  }
  out << '\n';
  remedies(result, out);
}

}  // namespace

std::string CalibrationResult::briefReport() const {
  std::ostringstream out;
  out << toString(verdict.status) << ':' << std::fixed;
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = (*this)[info.parameter];
    if (estimate.status != ParameterStatus::estimated) continue;
    out << ' ' << info.name << std::setprecision(tableDecimals(info.parameter)) << ' '
        << estimate.bias / info.internal_per_unit << " +- " << estimate.std / info.internal_per_unit
        << unitSuffix(info.parameter) << ',';
  }
  out << std::setprecision(3) << " sigma0 " << sigma0 << ", " << iterations.size() << " iterations";
  return out.str();
}

std::string CalibrationResult::fullReport() const {
  const CalibrationResult& result = *this;
  std::ostringstream out;
  if (result.systems.empty()) {
    out << "Biases (assumed - true)\n\n";
    parameterTable(result.parameters, out);
  }
  systemTables(result, out);
  priorLine(result, out);
  pairTable(result, out);
  controlTable(result, out);
  targetTable(result, out);
  heldTable(result, out);
  stripTable(result, out);
  largeCorrectionList(result, out);
  diagnosisTable(result, out);
  if (!result.observability.empty()) out << "\nWhat the block determines\n\n";
  for (const std::string& text : result.observability) out << "- " << text << '\n';
  out << "\nsigma0 " << std::setprecision(3) << result.sigma0 << ", redundancy "
      << result.redundancy << ", " << result.iterations.size() << " iterations, "
      << (result.converged ? "converged" : "NOT converged")
      << "\nverdict: " << result.verdict.text() << '\n';
  for (const Warning& warning : result.warnings) out << "\nwarning: " << warning.text << '\n';
  return out.str();
}

}  // namespace pcl_als
