// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/report/intensity_report.h>

#include "excluded_json.h"
#include "json_number.h"

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "pcl_als intensity";

Json modelJson(const RadiometricModel& model) {
  return {{"range_exponent", model.range_exponent},
          {"incidence_exponent", model.incidence_exponent},
          {"extinction_per_km", model.extinction_per_km},
          {"reference_range_m", model.reference_range},
          {"largest_incidence_deg", model.largest_incidence}};
}

Json atmosphereJson(const ExtinctionChoice& choice) {
  if (!choice.air) return {{"source", choice.remark}, {"extinction_per_km", choice.per_km}};
  const Atmosphere& air = *choice.air;
  return {{"visibility_km", air.visibility_km},
          {"temperature_c", air.temperature_c},
          {"pressure_kpa", air.pressure_kpa},
          {"relative_humidity_percent", air.relative_humidity},
          {"wavelength_nm", air.wavelength_nm},
          {"aerosol_per_km", choice.parts.aerosol},
          {"rayleigh_per_km", choice.parts.rayleigh},
          {"water_vapour_per_km", choice.parts.water_vapour},
          {"mixed_gases_per_km", choice.parts.mixed_gases},
          {"extinction_per_km", choice.per_km},
          {"two_way_transmission_of_1_km", twoWayTransmission(choice.per_km, 1000.0)}};
}

Json termJson(const EstimatedTerm& term) {
  Json json = {{"value", term.value}, {"status", nameOf(term.status)}};
  if (term.status == TermStatus::estimated) {
    json["std"] = number(term.std);
    json["std_formal"] = number(term.std_formal);
  }
  if (!term.reason.empty()) json["reason"] = term.reason;
  return json;
}

Json variationJson(const CellVariation& variation) {
  return {{"median", variation.median}, {"rms", variation.rms}, {"p90", variation.p90}};
}

Json overlapJson(const OverlapResult& overlaps, double cell_size) {
  Json correlation = Json::array();
  for (int row = 0; row < overlaps.correlation.rows(); ++row) {
    Json line = Json::array();
    for (int column = 0; column < overlaps.correlation.cols(); ++column)
      line.push_back(number(overlaps.correlation(row, column)));
    correlation.push_back(line);
  }
  return {{"cell_m", cell_size},
          {"cells", overlaps.cells},
          {"observations", overlaps.observations},
          {"clusters", overlaps.clusters},
          {"sigma0_relative", overlaps.sigma0},
          {"iterations", overlaps.iterations},
          {"converged", overlaps.converged},
          {"correlation", {{"order", overlaps.order}, {"matrix", correlation}}},
          {"coefficient_of_variation",
           {{"before", variationJson(overlaps.before)},
            {"given_model", variationJson(overlaps.physics)},
            {"after", variationJson(overlaps.after)}}}};
}

Json estimatesJson(const IntensityReport& report) {
  Json terms, gains = Json::array();
  const RadiometricModel& model = report.result->run->model();
  for (std::size_t t = 0; t < kRadiometricTermCount; ++t) {
    const auto term = static_cast<RadiometricTerm>(t);
    Json json = report.result->overlaps
                    ? termJson(report.result->overlaps->terms[t])
                    : Json{{"value", valueOf(term, model)}, {"status", "fixed"}};
    json["unit"] = unitOf(term);
    terms[nameOf(term)] = json;
  }
  for (std::size_t i = 0; i < report.result->run->strips().size(); ++i) {
    Json json = {{"strip", report.result->run->strips()[i]}};
    if (report.result->overlaps)
      json.update(termJson(report.result->overlaps->gains[i]));
    else
      json.update(Json{{"value", report.result->run->estimatedGains()[i]}, {"status", "fixed"}});
    gains.push_back(json);
  }
  return {{"terms", terms}, {"strip_gains", gains}};
}

Json referenceJson(const IntensityReport& report) {
  Json json = {{"constant", report.result->run->constant()}};
  if (!report.result->reference) return json;
  json["relative_std"] = report.result->reference->relative_std;
  json["relative_rms"] = report.result->reference->relative_rms;
  json["targets"] = Json::array();
  for (const ReferenceResult::Target& t : report.result->reference->targets) {
    json["targets"].push_back({{"id", t.id},
                               {"points", t.points},
                               {"used", t.used},
                               {"reflectance", t.reflectance},
                               {"measured", t.measured},
                               {"relative_std", t.relative_std}});
  }
  return json;
}

Json statisticsJson(const RunningStatistics& s, double scale) {
  return {{"points", s.count()},
          {"mean", s.mean()},
          {"std", s.standardDeviation()},
          {"variance_to_mean", scale * varianceToMean(s)}};
}

Json pairJson(const BeforeAfter& pair, double scale) {
  return {{"before", statisticsJson(pair.before, 1.0)},
          {"after", statisticsJson(pair.after, scale)}};
}

Json slopesJson(const std::function<BeforeAfter(std::size_t)>& of, double scale) {
  Json slopes = Json::array();
  for (std::size_t bin = 0; bin <= IntensityStatistics::kSlopeBins; ++bin) {
    const BeforeAfter pair = of(bin);
    if (pair.before.count() == 0) continue;
    Json json = pairJson(pair, scale);
    const double from = IntensityStatistics::kSlopeStep * static_cast<double>(bin);
    const bool surface = bin < IntensityStatistics::kSlopeBins;
    json["slope_from_deg"] = surface ? Json(from) : Json(nullptr);
    json["slope_to_deg"] = surface ? Json(from + IntensityStatistics::kSlopeStep) : Json(nullptr);
    slopes.push_back(json);
  }
  return slopes;
}

Json histogramJson(const IntensityHistogram& histogram) {
  // As many bins of whole numbers as give about 128 up to the largest value.
  std::size_t last = 0;
  for (std::size_t i = 0; i < histogram.before.size(); ++i)
    if (histogram.before[i] + histogram.after[i] > 0) last = i;
  const std::size_t width = last / 128 + 1;
  Json before = Json::array(), after = Json::array();
  for (std::size_t bin = 0; bin <= last; bin += width) {
    std::uint64_t b = 0, a = 0;
    for (std::size_t i = bin; i < std::min(bin + width, histogram.before.size()); ++i)
      b += histogram.before[i], a += histogram.after[i];
    before.push_back(b);
    after.push_back(a);
  }
  return {{"bin_width", width}, {"before", before}, {"after", after}};
}

Json reportJson(const IntensityReport& report) {
  const IntensityStatistics& statistics = report.result->outcome.statistics;
  const double scale = meanScale(statistics.all());
  Json json;
  json["note"] =
      "after: corrected intensity without output_scale; its variance_to_mean is brought to the "
      "mean "
      "before of all points, under strips to that of the strip";
  json["all"] = pairJson(statistics.all(), scale);
  json["slopes"] = slopesJson([&](std::size_t bin) { return statistics.slope(bin); }, scale);
  json["classes"] = Json::array();
  for (int code = 0; code < 256; ++code) {
    const BeforeAfter& pair = statistics.classOf(static_cast<std::uint8_t>(code));
    if (pair.before.count() == 0) continue;
    Json entry = {{"class", code}};
    entry.update(pairJson(pair, scale));
    json["classes"].push_back(entry);
  }
  json["strips"] = Json::array();
  for (std::size_t i = 0; i < statistics.strips(); ++i) {
    Json entry = {{"strip", report.result->run->strips()[i]}};
    const double own = meanScale(statistics.strip(i));
    entry.update(pairJson(statistics.strip(i), own));
    entry["slopes"] =
        slopesJson([&](std::size_t bin) { return statistics.stripSlope(i, bin); }, own);
    entry["histogram"] = histogramJson(report.result->outcome.histograms[i]);
    json["strips"].push_back(entry);
  }
  return json;
}

Json filesJson(const IntensityReport& report) {
  Json files = Json::array();
  for (std::size_t i = 0; i < report.result->run->files(); ++i) {
    const IntensityCounts& counts = report.result->outcome.counts[i];
    Json status;
    for (std::size_t k = 0; k < kRadiometryStatusCount; ++k)
      status[nameOf(static_cast<RadiometryStatus>(k))] = counts.status[k];
    files.push_back({{"input", report.result->run->input(i).path()},
                     {"output", report.outputs[i]},
                     {"points", counts.points},
                     {"points_by_status", status},
                     {"points_of_strips_not_chosen", counts.excluded},
                     {"zero_intensity", counts.zeros},
                     {"saturated_before", counts.saturated},
                     {"clipped_after", counts.clipped},
                     {"rounded_to_zero_after", counts.rounded_to_zero}});
  }
  return files;
}

double positive(const Json& json, const char* name, const std::string& file) {
  const auto at = json.find(name);
  if (at == json.end() || !at->is_number() || at->get<double>() < 0.0)
    throw InputError(file + ": '" + name + "' is not a number of 0 or more");
  return at->get<double>();
}

}  // namespace

std::string intensityJson(const IntensityReport& report) {
  Json json = {{"format", kFormat}, {"version", 1}, {"tool_version", PCL_ALS_VERSION}};
  json["model"] = modelJson(report.result->run->model());
  json["atmosphere"] = atmosphereJson(report.extinction);
  json.update(estimatesJson(report));
  if (report.result->overlaps)
    json["overlaps"] = overlapJson(*report.result->overlaps, report.result->run->cellSize());
  json["reflectance"] = referenceJson(report);
  json["output_scale"] = report.output.scale;
  json["saturation"] = report.result->run->saturation();
  json["echo_energy"] = report.result->run->settings().echo_energy;
  json["files"] = filesJson(report);
  json["left_out"] = excludedJson(report.result->excluded);
  json["warnings"] = textsOf(report.result->warnings);
  json["report"] = reportJson(report);
  return json.dump(1) + "\n";
}

void writeIntensityJson(const std::filesystem::path& path, const IntensityReport& report) {
  writeFile(path, intensityJson(report));
}

StoredRadiometry readIntensityJson(const std::filesystem::path& path) {
  const std::string name = path.string();
  const Json json = Json::parse(readWholeFile(path, kJsonLimits), nullptr, false);
  if (json.is_discarded() || !json.is_object() || json.value("format", "") != kFormat ||
      json.value("version", 0) != 1 || !json.contains("model") || !json["model"].is_object())
    throw InputError(name + ": is no result of pcl_als_intensity, version 1");
  StoredRadiometry stored;
  const Json& model = json["model"];
  stored.model.range_exponent = positive(model, "range_exponent", name);
  stored.model.incidence_exponent = positive(model, "incidence_exponent", name);
  stored.model.extinction_per_km = positive(model, "extinction_per_km", name);
  stored.model.reference_range = positive(model, "reference_range_m", name);
  stored.model.largest_incidence = positive(model, "largest_incidence_deg", name);
  if (json.contains("strip_gains") && json["strip_gains"].is_array()) {
    for (const Json& gain : json["strip_gains"]) {
      if (!gain.is_object() || !gain.contains("strip") || !gain["strip"].is_string())
        throw InputError(name + ": a strip gain names no strip");
      const double value = positive(gain, "value", name);
      if (value <= 0.0) throw InputError(name + ": a strip gain is 0");
      stored.gains[gain["strip"].get<std::string>()] = value;
    }
  }
  if (json.contains("reflectance") && json["reflectance"].is_object())
    stored.constant = positive(json["reflectance"], "constant", name);
  stored.echo_energy = json.contains("echo_energy") && json["echo_energy"] == true;
  return stored;
}

}  // namespace pcl_als
