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
};

/// What the correction did to some points.
struct Change {
  Scaled before, after;
  std::optional<double> from_slope, to_slope;
  std::string strip;
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
       {"variance_to_mean", [](const S& s) { return s.scale * varianceToMean(s.values); },
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
    strip.strip = report.result->run->strips()[i];
    strip.slopes = slopesOf([&](std::size_t b) { return statistics.stripSlope(i, b); }, scale);
    setHistogram(report.result->outcome.histograms[i], strip);
    strips.push_back(std::move(strip));
  }
  return strips;
}

/// Points, means, standard deviations, variance-to-mean ratios, change.
constexpr const char* kPairHeader =
    "points,mean_before,std_before,mean_after,std_after,variance_to_mean_before,"
    "variance_to_mean_after,change_percent\n";

/// A table in CSV: a name, then figures before and after.
class IntensityTable {
 public:
  explicit IntensityTable(const char* first) {
    csv_ << first << ',' << kPairHeader << std::setprecision(6);
  }
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
      {{"strip", &Change::strip, "Name of the strip"},
       F::all(kSameObject, intensityChangeFields()),
       {"slopes", &Change::slopes, intensitySlopeFields(), "By slope"},
       {"histogram", kSameObject, histogram, "By intensity"}});
  const auto all = [](const IntensityReport& r) {
    const BeforeAfter points = r.result->outcome.statistics.all();
    return Change(points, meanScale(points));
  };
  const auto slopes = [](const IntensityReport& r) {
    const IntensityStatistics& s = r.result->outcome.statistics;
    return slopesOf([&s](std::size_t bin) { return s.slope(bin); }, meanScale(s.all()));
  };
  static const Fields<IntensityReport> fields(
      "report", "Effect of the correction.",
      {Field<IntensityReport>::constant(
           "note",
           "after: corrected intensity without output_scale; its variance_to_mean is brought to "
           "the mean before of all points, under strips to that of the strip",
           ""),
       {"all", all, intensityChangeFields(), "All points"},
       {"slopes", slopes, intensitySlopeFields(), "By slope"},
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
  const IntensityStatistics& statistics = report.result->outcome.statistics;
  const double scale = meanScale(statistics.all());
  IntensityTable slopes("slope_deg"), classes("class"), strips("strip");
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
