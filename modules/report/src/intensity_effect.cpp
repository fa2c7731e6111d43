// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iomanip>
#include <sstream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/class_name.h>
#include <pcl_als/common/errors.h>

#include "intensity_fields.h"

namespace pcl_als {
namespace {

using namespace field;

/// Statistics, with the factor by which corrected values have the mean of the given ones.
struct Scaled {
  RunningStatistics values;
  double scale = 1.0;
  double ratio() const { return scale * varianceToMean(values); }
};

/// What the correction did to some points.
struct Change {
  Scaled before, after;
  std::string name;  ///< of the interval of slopes, the class or the strip
  std::optional<double> from_slope, to_slope;
  int code = 0;  ///< class
  std::vector<Change> slopes;
  std::size_t bin_width = 1;
  std::vector<std::uint64_t> histogram_before, histogram_after;

  Change() = default;
  Change(const BeforeAfter& points, double scale)
      : before{points.before, 1.0}, after{points.after, scale} {}
  bool any() const { return before.values.count() > 0; }
};

const Fields<Change>& intensityChangeFields() {
  using S = Scaled;
  static const Fields<S> statistics(
      "statistics", "Statistics of intensities.",
      {{"points", [](const S& s) { return s.values.count(); }, "Number of points"},
       {"mean", [](const S& s) { return s.values.mean(); }, "Mean"},
       {"std", [](const S& s) { return s.values.standardDeviation(); }, "Standard deviation"},
       {"variance_to_mean", &S::ratio,
        "Variance over mean; after the correction of values with the mean before"}});
  static const Fields<Change> fields("change", "Intensities before and after the correction.",
                                     {{"before", &Change::before, statistics, "Before"},
                                      {"after", &Change::after, statistics, "After"}});
  return fields;
}

const Fields<Change>& intensitySlopeFields() {
  static const Fields<Change> fields(
      "slope", "Points of an interval of slopes.",
      {Field<Change>::all(kSameObject, intensityChangeFields()),
       {"slope_from_deg", &Change::from_slope, "Least slope; null: points without a surface"},
       {"slope_to_deg", &Change::to_slope, "Largest slope"}});
  return fields;
}

std::vector<Change> slopesOf(const std::function<BeforeAfter(std::size_t)>& of, double scale) {
  std::vector<Change> slopes;
  for (std::size_t bin = 0; bin <= IntensityStatistics::kSlopeBins; ++bin) {
    Change change(of(bin), scale);
    if (!change.any()) continue;
    change.name = slopeName(bin);
    if (bin < IntensityStatistics::kSlopeBins) {
      change.from_slope = IntensityStatistics::kSlopeStep * static_cast<double>(bin);
      change.to_slope = *change.from_slope + IntensityStatistics::kSlopeStep;
    }
    slopes.push_back(std::move(change));
  }
  return slopes;
}

std::vector<Change> classesOf(const IntensityReport& report) {
  const IntensityStatistics& statistics = report.result->outcome.statistics;
  const double scale = meanScale(statistics.all());
  std::vector<Change> classes;
  for (int code = 0; code < 256; ++code) {
    Change change(statistics.classOf(static_cast<std::uint8_t>(code)), scale);
    change.code = code;
    change.name = className(code);
    if (change.any()) classes.push_back(std::move(change));
  }
  return classes;
}

/// As many bins of whole numbers as give about 128 up to the largest value.
void setHistogram(const IntensityHistogram& histogram, Change& strip) {
  std::size_t last = 0;
  for (std::size_t i = 0; i < histogram.before.size(); ++i)
    if (histogram.before[i] + histogram.after[i] > 0) last = i;
  strip.bin_width = last / 128 + 1;
  strip.histogram_before.resize(last / strip.bin_width + 1);
  strip.histogram_after = strip.histogram_before;
  for (std::size_t i = 0; i <= last; ++i) {
    strip.histogram_before[i / strip.bin_width] += histogram.before[i];
    strip.histogram_after[i / strip.bin_width] += histogram.after[i];
  }
}

std::vector<Change> stripsOf(const IntensityReport& report) {
  const IntensityStatistics& statistics = report.result->outcome.statistics;
  std::vector<Change> strips;
  for (std::size_t i = 0; i < statistics.strips(); ++i) {
    const double scale = meanScale(statistics.strip(i));
    Change strip(statistics.strip(i), scale);
    strip.name = report.result->run->strips()[i];
    strip.slopes = slopesOf([&](std::size_t b) { return statistics.stripSlope(i, b); }, scale);
    setHistogram(report.result->outcome.histograms[i], strip);
    strips.push_back(std::move(strip));
  }
  return strips;
}

std::vector<Change> allSlopes(const IntensityReport& report) {
  const IntensityStatistics& s = report.result->outcome.statistics;
  return slopesOf([&s](std::size_t bin) { return s.slope(bin); }, meanScale(s.all()));
}

/// A table of figures before and after, by name.
std::string changesCsv(const char* first, const std::vector<Change>& changes) {
  std::ostringstream csv;
  csv << first
      << ",points,mean_before,std_before,mean_after,std_after,variance_to_mean_before,"
         "variance_to_mean_after,change_percent\n"
      << std::setprecision(6);
  for (const Change& c : changes) {
    if (!c.any()) continue;
    const double before = c.before.ratio(), after = c.after.ratio();
    csv << c.name << ',' << c.before.values.count();
    for (const RunningStatistics* s : {&c.before.values, &c.after.values})
      csv << ',' << s->mean() << ',' << s->standardDeviation();
    csv << ',' << before << ',' << after << ','
        << (before > 0.0 ? 100.0 * (after / before - 1.0) : 0.0) << '\n';
  }
  return csv.str();
}

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

}  // namespace

const Fields<IntensityReport>& intensityEffectFields() {
  using F = Field<Change>;
  static const Fields<Change> class_of("class", "Points of one class.",
                                       {{"class", &Change::code, "Number of the class"},
                                        F::all(kSameObject, intensityChangeFields())});
  static const Fields<Change> histogram("histogram", "Numbers of points by intensity.",
                                        {{"bin_width", &Change::bin_width, "Width of a bin"},
                                         {"before", &Change::histogram_before, ""},
                                         {"after", &Change::histogram_after, ""}});
  static const Fields<Change> strip(
      "strip", "Points of one strip.",
      {{"strip", &Change::name, "Name of the strip"},
       F::all(kSameObject, intensityChangeFields()),
       {"slopes", &Change::slopes, intensitySlopeFields(), "By slope"},
       {"histogram", kSameObject, histogram, "By intensity"}});
  const auto all = [](const IntensityReport& r) {
    const BeforeAfter points = r.result->outcome.statistics.all();
    return Change(points, meanScale(points));
  };
  static const Fields<IntensityReport> fields(
      "report", "Effect of the correction.",
      {Field<IntensityReport>::constant(
           "note",
           "after: corrected intensity without output_scale; its variance_to_mean is brought to "
           "the mean before of all points, under strips to that of the strip",
           ""),
       {"all", all, intensityChangeFields(), "All points"},
       {"slopes", allSlopes, intensitySlopeFields(), "By slope"},
       {"classes", classesOf, class_of, "By class"},
       {"strips", stripsOf, strip, "By strip"}});
  return fields;
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

void writeIntensityTables(const std::filesystem::path& folder, const IntensityReport& report) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string() + ": cannot make this folder");
  writeFile(folder / "slopes.csv", changesCsv("slope_deg", allSlopes(report)));
  writeFile(folder / "classes.csv", changesCsv("class", classesOf(report)));
  writeFile(folder / "strips.csv", changesCsv("strip", stripsOf(report)));
  writeFile(folder / "histograms.csv", histogramsCsv(report));
}

}  // namespace pcl_als
