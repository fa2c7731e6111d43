// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/common/fields.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/report/intensity_report.h>

#include "intensity_fields.h"

namespace pcl_als {
namespace {

using namespace field;
using Report = IntensityReport;

constexpr const char* kFormat = "pcl_als intensity";

/// Null and negative values are refused.
void knownNotNegative(FieldRow& row) {
  alwaysKnown(row), notNegative(row);
}

const Fields<RadiometricModel>& radiometricModelFields() {
  using M = RadiometricModel;
  static const Fields<M> fields(
      "model", "Corrected intensity is that at the reference range, at normal incidence.",
      {{"range_exponent", &M::range_exponent, "Exponent of the range", knownNotNegative},
       {"incidence_exponent", &M::incidence_exponent, "Exponent of its cosine", knownNotNegative},
       {"extinction_per_km", &M::extinction_per_km, "Extinction of the air, one way",
        knownNotNegative},
       {"reference_range_m", &M::reference_range, "Reference range", knownNotNegative},
       {"largest_incidence_deg", &M::largest_incidence, "Limit of the angle", knownNotNegative}});
  return fields;
}

const Fields<ExtinctionChoice>& atmosphereFields() {
  using A = Atmosphere;
  using C = ExtinctionChoice;
  using E = Extinction;
  static const Fields<A> air(
      "air", "State of the air.",
      {{"visibility_km", &A::visibility_km, "Meteorological range"},
       {"temperature_c", &A::temperature_c, "Temperature"},
       {"pressure_kpa", &A::pressure_kpa, "Pressure"},
       {"relative_humidity_percent", &A::relative_humidity, "Relative humidity"},
       {"wavelength_nm", &A::wavelength_nm, "Wavelength of the laser"}});
  static const Fields<E> parts("extinction", "Extinction by its causes.",
                               {{"aerosol_per_km", &E::aerosol, "By aerosol"},
                                {"rayleigh_per_km", &E::rayleigh, "By molecules"},
                                {"water_vapour_per_km", &E::water_vapour, "By water vapour"},
                                {"mixed_gases_per_km", &E::mixed_gases, "By other gases"}});
  const auto computed = [](const C& c) { return c.air.has_value(); };
  static const Fields<C> fields(
      "atmosphere", "Source of the extinction.",
      {{"source", &C::remark, "What it is from, if it is not computed from the state of the air",
        onlyIf([](const C& c) { return !c.air; })},
       Field<C>::all([](const C& c) -> const A& { return *c.air; }, air, onlyIf(computed)),
       Field<C>::all(&C::parts, parts, onlyIf(computed)),
       {"extinction_per_km", &C::per_km, "Extinction, one way"},
       {"two_way_transmission_of_1_km",
        [](const C& c) { return twoWayTransmission(c.per_km, 1e3); },
        "Share of the light that is left after 1 km there and back", onlyIf(computed)}});
  return fields;
}

/// A term or gain with its unit or strip.
struct NamedTerm {
  EstimatedTerm term;
  std::string name;
};

const Fields<EstimatedTerm>& termFields() {
  using T = EstimatedTerm;
  using Status = TermStatus;
  const auto estimated = onlyIf([](const T& term) { return term.status == Status::estimated; });
  static const Fields<T> fields(
      "estimate", "A parameter of the intensities.",
      {{"value", &T::value, "Value that is used", knownNotNegative},
       {"status", &T::status,
        FieldNames<Status>(nameOf, {Status::fixed, Status::estimated, Status::not_estimable}),
        "Whether it was estimated", mayBeMissing},
       {"std", &T::std, "Standard deviation; that of a gain is relative", estimated},
       {"std_formal", &T::std_formal, "The same with independent cells", estimated},
       {"reason", &T::reason, "Why it is not estimable", unlessEmpty}});
  return fields;
}

NamedValues<NamedTerm> termsOf(const Report& report) {
  NamedValues<NamedTerm> terms;
  for (std::size_t t = 0; t < kRadiometricTermCount; ++t) {
    const auto term = static_cast<RadiometricTerm>(t);
    EstimatedTerm value;
    value.value = valueOf(term, report.result->run->model());
    if (report.result->overlaps) value = report.result->overlaps->terms[t];
    terms.push_back({nameOf(term), {value, unitOf(term)}});
  }
  return terms;
}

std::vector<NamedTerm> gainsOf(const Report& report) {
  const IntensityRun& run = *report.result->run;
  std::vector<NamedTerm> gains;
  for (std::size_t i = 0; i < run.strips().size(); ++i) {
    EstimatedTerm value;
    value.value = run.estimatedGains()[i];
    if (report.result->overlaps) value = report.result->overlaps->gains[i];
    gains.push_back({value, run.strips()[i]});
  }
  return gains;
}

const Fields<NamedTerm>& gainFields() {
  static const Fields<NamedTerm> fields("gain", "Factor of what a strip received.",
                                        {{"strip", &NamedTerm::name, "Name of the strip"},
                                         Field<NamedTerm>::all(&NamedTerm::term, termFields())});
  return fields;
}

const Fields<OverlapResult>& overlapFields() {
  using O = OverlapResult;
  using V = CellVariation;
  static const Fields<O> correlation("correlation", "Correlations of the estimates.",
                                     {{"order", &O::order, "Terms, then gains of strips"},
                                      {"matrix", &O::correlation, "Correlations"}});
  static const Fields<V> variation("variation", "Coefficient of variation of cells.",
                                   {{"median", &V::median, "Median"},
                                    {"rms", &V::rms, "Root mean square"},
                                    {"p90", &V::p90, "90th percentile"}});
  static const Fields<O> variations("variations", "Coefficients of variation by correction.",
                                    {{"before", &O::before, variation, "Without correction"},
                                     {"given_model", &O::physics, variation, "The given model"},
                                     {"after", &O::after, variation, "This result"}});
  static const Fields<O> fields(
      "overlap", "Comparison of overlapping strips.",
      {{"cells", &O::cells, "Number of cells"},
       {"observations", &O::observations, "Number of means of strips in cells"},
       {"clusters", &O::clusters, "Groups of cells that share errors"},
       {"sigma0_relative", &O::sigma0, "Relative standard deviation of a mean of five points"},
       {"iterations", &O::iterations, "Number of iterations"},
       {"converged", &O::converged, "Whether the adjustment converged"},
       {"correlation", kSameObject, correlation, "Correlations"},
       {"coefficient_of_variation", kSameObject, variations, "Of strips in a cell"}});
  return fields;
}

const Fields<Report>& radiometricEstimateFields() {
  using F = Field<Report>;
  using R = ReferenceResult;
  using T = R::Target;
  static const Fields<T> target(
      "target", "A target of known reflectance.",
      {{"id", &T::id, "Name of the target"},
       {"points", &T::points, "Points on it"},
       {"used", &T::used, "Whether it was used"},
       {"reflectance", &T::reflectance, "Reflectance that is given"},
       {"measured", &T::measured, "Reflectance from the points"},
       {"relative_std", &T::relative_std, "Relative standard deviation of the points' median"}});
  static const Fields<R> targets("targets", "Factor to reflectance from targets.",
                                 {{"relative_std", &R::relative_std, "Of the constant"},
                                  {"relative_rms", &R::relative_rms, "Of used targets"},
                                  {"targets", &R::targets, target, "Targets"}});
  static const Fields<Report> reference(
      "reflectance", "Factor to reflectance.",
      {{"constant", [](const Report& r) { return r.result->run->constant(); },
        "Corrected intensity of reflectance 1; 0: not known"},
       F::all([](const Report& r) -> const R& { return *r.result->reference; }, targets,
              onlyIf([](const Report& r) { return r.result->reference.has_value(); }))});
  static const Fields<Report> overlaps(
      "overlaps", "Estimates from overlapping strips.",
      {{"cell_m", [](const Report& r) { return r.result->run->cellSize(); }, "Size of a cell"},
       F::all(
           [](const Report& r) -> const auto& { return *r.result->overlaps; }, overlapFields())});
  static const Fields<NamedTerm> term("term", "A term of the model.",
                                      {Field<NamedTerm>::all(&NamedTerm::term, termFields()),
                                       {"unit", &NamedTerm::name, "Unit of its values"}});
  static const Fields<Report> fields(
      "estimates", "What was estimated.",
      {{"terms", termsOf, term, "Terms of the model"},
       {"strip_gains", gainsOf, gainFields(), "Gains of the strips"},
       {"overlaps", kSameObject, overlaps, "From overlapping strips",
        onlyIf([](const Report& r) { return r.result->overlaps.has_value(); })},
       {"reflectance", kSameObject, reference, "Factor to reflectance"}});
  return fields;
}

/// A file of the run.
struct FileOf {
  const Report* report;
  std::size_t index;
  const IntensityCounts& counts() const { return report->result->outcome.counts[index]; }
};

std::vector<FileOf> filesOf(const Report& report) {
  std::vector<FileOf> files;
  for (std::size_t i = 0; i < report.result->run->files(); ++i) files.push_back({&report, i});
  return files;
}

NamedValues<std::uint64_t> statusOf(const FileOf& file) {
  NamedValues<std::uint64_t> points;
  for (std::size_t k = 0; k < kRadiometryStatusCount; ++k)
    points.emplace_back(nameOf(static_cast<RadiometryStatus>(k)), file.counts().status[k]);
  return points;
}

const Fields<FileOf>& intensityFileFields() {
  using C = IntensityCounts;
  using F = FileOf;
  static const Fields<C> counts(
      "counts", "Points of a file.",
      {{"points_of_strips_not_chosen", &C::excluded, "Points that stay as they are"},
       {"zero_intensity", &C::zeros, "Points with an intensity of 0"},
       {"saturated_before", &C::saturated, "Points with the largest intensity"},
       {"clipped_after", &C::clipped, "Points that exceed 65535 after the correction"},
       {"rounded_to_zero_after", &C::rounded_to_zero, "Points that become 0"}});
  static const Fields<F> fields(
      "file", "A file of the run.",
      {{"input", [](const F& f) { return f.report->result->run->input(f.index).path(); }, "File"},
       {"output", [](const F& f) { return f.report->outputs[f.index]; }, "Corrected file"},
       {"points", [](const F& f) { return f.counts().points; }, "Number of points"},
       {"points_by_status", statusOf, "Points by what was corrected"},
       Field<F>::all([](const F& f) -> const C& { return f.counts(); }, counts)});
  return fields;
}

const RadiometricModel& modelOf(const Report& report) {
  return report.result->run->model();
}
double outputScale(const Report& report) {
  return report.output.scale;
}
double saturationOf(const Report& report) {
  return report.result->run->saturation();
}
bool usesEchoEnergy(const Report& report) {
  return report.result->run->settings().echo_energy;
}
std::vector<ExcludedPoints> excludedOf(const Report& report) {
  return report.result->excluded;
}
std::vector<std::string> warningTexts(const Report& report) {
  return textsOf(report.result->warnings);
}

}  // namespace

const FieldTable& intensityFields() {
  using F = Field<Report>;
  static const Fields<Report> fields(
      "intensity", "Result of `pcl_als_intensity`.",
      {F::constant("format", kFormat, ""),
       F::constant("version", 1, ""),
       toolVersionField<Report>(),
       {"model", modelOf, radiometricModelFields(), "Model of the correction"},
       {"atmosphere", &Report::extinction, atmosphereFields(), "Source of the extinction"},
       F::all(kSameObject, radiometricEstimateFields()),
       {"output_scale", outputScale, "Factor on corrected intensities in the files"},
       {"saturation", saturationOf, "Intensity from which on points are saturated"},
       {"echo_energy", usesEchoEnergy, "Whether energies of echoes replace intensities"},
       {"files", filesOf, intensityFileFields(), "Files"},
       {"left_out", excludedOf, excludedFields(), "Points that stay as they are"},
       {"warnings", warningTexts, "What a user should know"},
       {"report", kSameObject, intensityEffectFields(), "Effect of the correction"}});
  return fields;
}

std::string intensityJson(const Report& report) {
  return jsonText(intensityFields().write(&report));
}

StoredRadiometry readIntensityJson(const std::filesystem::path& path) {
  const FieldValue file = parseJson(readWholeFile(path, kJsonLimits), path.string());
  const FieldNode root(file, path.string());
  if (!root.has("format") || root["format"].text() != kFormat || root["version"].whole() != 1)
    root.refuse("is no result of pcl_als_intensity, version 1");
  StoredRadiometry stored;
  radiometricModelFields().read(stored.model, root["model"]);
  if (root.has("strip_gains")) {
    for (const FieldNode& node : root["strip_gains"].items()) {
      NamedTerm gain;
      gainFields().read(gain, node);
      if (gain.term.value == 0.0) node["value"].refuse("must not be 0");
      stored.gains[gain.name] = gain.term.value;
    }
  }
  stored.echo_energy = root.has("echo_energy") && root["echo_energy"].truth();
  if (!root.has("reflectance")) return stored;
  const FieldNode constant = root["reflectance"]["constant"];
  stored.constant = constant.number();
  if (stored.constant < 0.0) constant.refuse("must not be negative");
  return stored;
}

}  // namespace pcl_als
