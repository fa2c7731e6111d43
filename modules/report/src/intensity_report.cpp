// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iomanip>
#include <sstream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/class_name.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/report/intensity_report.h>

namespace pcl_als {
namespace {

/// Points, means, standard deviations, variance-to-mean ratios, change.
constexpr const char* kPairHeader =
    "points,mean_before,std_before,mean_after,std_after,variance_to_mean_before,"
    "variance_to_mean_after,change_percent\n";

/// A table in CSV: a name, then figures before and after.
class Table {
 public:
  explicit Table(const char* first) { csv_ << first << ',' << kPairHeader << std::setprecision(6); }
  void add(const std::string& name, const BeforeAfter& pair, double scale) {
    if (pair.before.count() == 0) return;
    const double before = varianceToMean(pair.before), after = scale * varianceToMean(pair.after);
    csv_ << name << ',' << pair.before.count() << ',' << pair.before.mean() << ','
         << pair.before.standardDeviation() << ',' << pair.after.mean() << ','
         << pair.after.standardDeviation() << ',' << before << ',' << after << ','
         << (before > 0.0 ? 100.0 * (after / before - 1.0) : 0.0) << '\n';
  }
  std::string text() const { return csv_.str(); }

 private:
  std::ostringstream csv_;
};

std::string histogramsCsv(const IntensityReport& report) {
  std::ostringstream csv;
  csv << "strip,intensity,before,after\n";
  for (std::size_t strip = 0; strip < report.result->outcome.histograms.size(); ++strip) {
    const IntensityHistogram& histogram = report.result->outcome.histograms[strip];
    for (std::size_t i = 0; i < histogram.before.size(); ++i) {
      if (histogram.before[i] + histogram.after[i] == 0) continue;
      csv << report.result->run->strips()[strip] << ',' << i << ',' << histogram.before[i] << ','
          << histogram.after[i] << '\n';
    }
  }
  return csv.str();
}

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

std::string slopeName(std::size_t bin) {
  if (bin >= IntensityStatistics::kSlopeBins) return "no surface";
  const int step = static_cast<int>(IntensityStatistics::kSlopeStep);
  const int from = step * static_cast<int>(bin);
  return std::to_string(from) + "-" + std::to_string(from + step);
}

double meanScale(const BeforeAfter& all) {
  return all.after.mean() > 0.0 ? all.before.mean() / all.after.mean() : 1.0;
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

void writeIntensityTables(const std::filesystem::path& folder, const IntensityReport& report) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string() + ": cannot make this folder");
  const IntensityStatistics& statistics = report.result->outcome.statistics;
  const double scale = meanScale(statistics.all());
  Table slopes("slope_deg"), classes("class"), strips("strip");
  for (std::size_t bin = 0; bin <= IntensityStatistics::kSlopeBins; ++bin)
    slopes.add(slopeName(bin), statistics.slope(bin), scale);
  for (int code = 0; code < 256; ++code)
    classes.add(className(code), statistics.classOf(static_cast<std::uint8_t>(code)), scale);
  for (std::size_t i = 0; i < statistics.strips(); ++i)
    strips.add(report.result->run->strips()[i], statistics.strip(i),
               meanScale(statistics.strip(i)));
  writeFile(folder / "slopes.csv", slopes.text());
  writeFile(folder / "classes.csv", classes.text());
  writeFile(folder / "strips.csv", strips.text());
  writeFile(folder / "histograms.csv", histogramsCsv(report));
}

}  // namespace pcl_als
