// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iomanip>
#include <sstream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/class_name.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/report/intensity_report.h>

namespace pcl_als {
namespace {

/// One line of a table: points, means, standard deviations, variance-to-mean ratios, change.
void pairColumns(const BeforeAfter& pair, double scale, const char* separator, std::ostream& out) {
  const double before = varianceToMean(pair.before), after = scale * varianceToMean(pair.after);
  out << pair.before.count() << separator << pair.before.mean() << separator
      << pair.before.standardDeviation() << separator << pair.after.mean() << separator
      << pair.after.standardDeviation() << separator << before << separator << after << separator
      << (before > 0.0 ? 100.0 * (after / before - 1.0) : 0.0);
}

constexpr const char* kPairHeader =
    "points,mean_before,std_before,mean_after,std_after,variance_to_mean_before,"
    "variance_to_mean_after,change_percent\n";
constexpr const char* kPairHead =
    "points | mean before | sd before | mean after | sd after | variance/mean before | after | "
    "change % |\n";
constexpr const char* kPairRule = "---|---|---|---|---|---|---|---|\n";

struct Table {
  std::ostringstream csv, markdown;
  explicit Table(const char* first) {
    csv << first << ',' << kPairHeader << std::setprecision(6);
    markdown << "| " << first << " | " << kPairHead << "|---|" << kPairRule << std::fixed
             << std::setprecision(1);
  }
  void add(const std::string& name, const BeforeAfter& pair, double scale) {
    if (pair.before.count() == 0) return;
    csv << name << ',';
    pairColumns(pair, scale, ",", csv);
    csv << '\n';
    markdown << "| " << name << " | ";
    pairColumns(pair, scale, " | ", markdown);
    markdown << " |\n";
  }
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
        << " points of strips that are left out\n";
  if (counts.zeros + counts.saturated > 0)
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

namespace {

std::string markdownOf(const IntensityReport& report, const Table& slopes, const Table& classes,
                       const Table& strips) {
  std::ostringstream page;
  const RadiometricModel& model = report.result->run->model();
  page << "# Radiometric correction\n\nReference range " << model.reference_range
       << " m, range exponent " << model.range_exponent << ", incidence exponent "
       << model.incidence_exponent << ", extinction " << model.extinction_per_km << " per km; "
       << report.extinction.remark
       << ".\n\nVariance-to-mean ratios after correction are brought to "
       << "the mean of the given intensities (of all points; by strip: of the strip). Zero and "
          "saturated intensities are left out.\n\n"
       << "## By slope\n\n"
       << slopes.markdown.str() << "\n## By class\n\n"
       << classes.markdown.str() << "\n## By strip\n\n"
       << strips.markdown.str();
  if (report.result->overlaps)
    page << "\n## Overlaps\n\n```\n"
         << overlapText(*report.result->overlaps, report.result->run->strips()) << "```\n";
  if (report.result->reference)
    page << "\n## Targets\n\n```\n" << referenceText(*report.result->reference) << "```\n";
  page << "\n## Points\n";
  for (std::size_t i = 0; i < report.result->run->files(); ++i)
    page << "\n"
         << report.result->run->input(i).path() << "\n```\n"
         << countsText(report.result->outcome.counts[i], *report.result->run) << "```\n";
  for (const Warning& warning : report.result->warnings) page << "\n- " << warning.text;
  return page.str() + "\n";
}

}  // namespace

void writeIntensityReport(const std::filesystem::path& folder, const IntensityReport& report,
                          bool markdown) {
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
  writeFile(folder / "slopes.csv", slopes.csv.str());
  writeFile(folder / "classes.csv", classes.csv.str());
  writeFile(folder / "strips.csv", strips.csv.str());
  writeFile(folder / "histograms.csv", histogramsCsv(report));
  if (markdown) writeFile(folder / "report.md", markdownOf(report, slopes, classes, strips));
}

}  // namespace pcl_als
