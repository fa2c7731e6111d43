// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iomanip>
#include <sstream>

#include <pcl_als/common/number_text.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/report/intensity_report.h>

namespace pcl_als {
namespace {

void variationLine(const char* name, const CellVariation& v, std::ostream& out) {
  out << "  " << std::left << std::setw(32) << name << std::right << std::fixed
      << std::setprecision(4) << "median " << v.median << ", RMS " << v.rms << ", 90 % under "
      << v.p90 << '\n';
}

void termLine(const std::string& name, const EstimatedTerm& term, std::ostream& out) {
  out << "  " << std::left << std::setw(24) << name << std::right << std::fixed
      << std::setprecision(4) << std::setw(10) << term.value << "  ";
  if (term.status == TermStatus::estimated)
    out << "std " << term.std;
  else
    out << nameOf(term.status);
  if (!term.reason.empty()) out << ": " << term.reason;
  out << '\n';
}

}  // namespace

std::string extinctionText(const ExtinctionChoice& choice) {
  std::ostringstream text;
  text.precision(3);
  text << "atmosphere: extinction " << choice.per_km << " per km";
  if (choice.air) {
    text << " (aerosol " << choice.parts.aerosol << ", Rayleigh " << choice.parts.rayleigh
         << ", water vapour " << choice.parts.water_vapour << ", mixed gases "
         << choice.parts.mixed_gases << ")";
  } else {
    text << " as given";
  }
  text << ", two-way transmission of 1 km " << twoWayTransmission(choice.per_km, 1000.0);
  return text.str();
}

std::string overlapText(const OverlapResult& overlaps, const std::vector<std::string>& strips) {
  std::ostringstream out;
  forEachTerm(overlaps, strips, [&out](const std::string& name, const EstimatedTerm& term) {
    if (term.status != TermStatus::fixed) termLine(name, term, out);
  });
  if (overlaps.cells == 0) return out.str();
  out << "Differences of strips in " << overlaps.cells
      << " smooth cells (standard deviation over mean of a cell)\n";
  variationLine("as received", overlaps.before, out);
  variationLine("with the given model", overlaps.physics, out);
  if (!overlaps.order.empty()) variationLine("with the estimated terms", overlaps.after, out);
  return out.str();
}

std::string referenceText(const ReferenceResult& reference) {
  std::ostringstream out;
  if (reference.constant <= 0.0) return "  no target has enough points\n";
  out << "  reflectance = corrected intensity / " << reference.constant << ", relative std "
      << std::setprecision(2) << reference.relative_std;
  if (reference.relative_rms > 0.0)
    out << ", targets differ by " << reference.relative_rms << " (relative RMS)";
  out << '\n';
  return out.str();
}

std::string countsText(const IntensityCounts& counts, const IntensityRun& run) {
  std::ostringstream out;
  const auto count = [&](RadiometryStatus s) { return counts.status[static_cast<std::size_t>(s)]; };
  out << "  range, atmosphere and incidence: " << grouped(count(RadiometryStatus::surface))
      << " points; range and atmosphere only: " << grouped(count(RadiometryStatus::no_surface))
      << " without a surface, " << grouped(count(RadiometryStatus::partial))
      << " returns before the last\n";
  if (count(RadiometryStatus::limited) > 0)
    out << "  incidence limited to " << run.model().largest_incidence
        << " degrees: " << grouped(count(RadiometryStatus::limited)) << " points\n";
  const std::uint64_t left = count(RadiometryStatus::uncovered) +
                             count(RadiometryStatus::above_sensor) +
                             count(RadiometryStatus::not_finite);
  if (left > 0)
    out << "  left as they are: " << grouped(count(RadiometryStatus::uncovered))
        << " points without a trajectory, " << grouped(count(RadiometryStatus::above_sensor))
        << " above the sensor, " << grouped(count(RadiometryStatus::not_finite))
        << " without coordinates\n";
  if (counts.excluded > 0)
    out << "  left as they are: " << grouped(counts.excluded)
        << " points of strips that are excluded\n";
  if (run.settings().echo_energy && counts.zeros > 0)
    out << "  without an echo: " << grouped(counts.zeros) << " points, written as 0\n";
  else if (counts.zeros + counts.saturated > 0)
    out << "  of intensity 0: " << grouped(counts.zeros) << " points; saturated ("
        << run.saturation() << " and more): " << grouped(counts.saturated)
        << ", their values are lower bounds\n";
  if (counts.clipped > 0)
    out << "  beyond 65535 after correction: " << grouped(counts.clipped)
        << " points, written as 65535; a smaller scale keeps them\n";
  if (counts.rounded_to_zero > 0)
    out << "  under 0.5 after correction: " << grouped(counts.rounded_to_zero)
        << " points, written as 0; a larger scale keeps them\n";
  return out.str();
}

}  // namespace pcl_als
