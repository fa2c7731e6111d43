// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/las/las_file.h>

#include "inventory_fields.h"

namespace pcl_als {
namespace {

using namespace field;

/// The counts that are not zero, by their number.
template <typename Counts>
auto numbered(Counts PointStatistics::*member) {
  return [member](const PointStatistics& s) {
    NamedValues<std::uint64_t> named;
    for (std::size_t i = 0; i < (s.*member).size(); ++i)
      if ((s.*member)[i] > 0) named.emplace_back(std::to_string(i), (s.*member)[i]);
    return named;
  };
}

const Fields<PointStatistics>& statisticsFields() {
  using S = PointStatistics;
  static const Fields<S> fields(
      "statistics", "Statistics of points; 0 without points.",
      {{"points", &S::points, "Number of points"},
       {"first_returns", &S::first_returns, "First returns"},
       {"single_returns", &S::single_returns, "Single returns"},
       {"minimum", &S::minimum, "Least coordinates", of("m")},
       {"maximum", &S::maximum, "Largest coordinates", of("m")},
       {"time", [](const S& s) { return Eigen::Vector2d(s.first_time, s.last_time); },
        "First and last time, as the file counts", of("s")},
       {"scan_angle_deg",
        [](const S& s) { return Eigen::Vector2d(s.least_scan_angle, s.largest_scan_angle); },
        "Least and largest scan angle"},
       {"intensity",
        [](const S& s) { return Eigen::Vector2d(s.least_intensity, s.largest_intensity); },
        "Least and largest intensity"},
       {"unsorted_times", &S::unsorted_times, "Points that are earlier than the one before"},
       {"zero_times", &S::zero_times, "Points with the time 0"},
       {"invalid_times", &S::invalid_times, "Points whose time is no number"},
       {"invalid_coordinates", &S::invalid_coordinates, "Points that are nowhere on Earth"},
       {"wrong_returns", &S::wrong_returns, "Return number 0, or above the number of returns"},
       {"withheld", &S::withheld, "Points with the flag withheld"},
       {"synthetic", &S::synthetic, "Points with the flag synthetic"},
       {"overlap_flags", &S::overlap_flags, "Points with the flag overlap"},
       {"channels", [](const S& s) { return std::vector(s.channels.begin(), s.channels.end()); },
        "Points by scanner channel"},
       {"returns", numbered(&S::returns), "Points by return number"},
       {"classes", numbered(&S::classes), "Points by class"}});
  return fields;
}

const Fields<LasFile>& lasFields() {
  using E = LasExtraField;
  using L = LasFile;
  using V = LasVlrEntry;
  static const Fields<E> extra("extra_field", "An extra field.",
                               {{"name", &E::name, "Its name"},
                                {"description", &E::description, "Its description"},
                                {"type", lasExtraTypeName, "Its type"},
                                {"position", &E::position, "First byte in the record"}});
  static const Fields<V> vlr("vlr", "A variable length record.",
                             {{"user", &V::user_id, "User id"},
                              {"record", &V::record_id, "Record id"},
                              {"bytes", &V::length, "Length"},
                              {"extended", &V::extended, "Whether it is extended"}});
  static const Fields<L> fields(
      "las", "Of LAS and LAZ files.",
      {{"generating_software", [](const L& l) { return l.header().generating_software; }, ""},
       {"system", [](const L& l) { return l.header().system_id; }, "Sensor or process"},
       {"record_length", [](const L& l) { return l.header().record_length; }, "Bytes of a point"},
       {"extra_fields", [](const L& l) { return l.extraFields(); }, extra, "Extra fields"},
       {"vlrs", [](const L& l) { return l.vlrs(); }, vlr, "Variable length records"}});
  return fields;
}

/// A unit of length with what states it.
struct StatedUnit {
  LengthUnit unit;
  std::optional<std::string> source;
};

StatedUnit stated(const LengthUnit& unit, const std::string& source) {
  return {unit, source.empty() ? std::nullopt : std::optional(source)};
}

FieldValue unitsOf(const PointFileInfo& info) {
  using U = StatedUnit;
  static const Fields<U> unit("unit", "",
                              {{"name", [](const U& u) { return u.unit.name; }, ""},
                               {"metres", [](const U& u) { return u.unit.metres; }, ""},
                               {"stated_by", &U::source, ""}});
  if (info.crs_kind == CrsKind::geographic) return "degrees";
  const LinearUnits& units = info.units;
  return FieldValue::Object{
      {"horizontal", unit.write(stated(units.horizontal, units.source))},
      {"vertical", unit.write(stated(units.vertical, units.vertical_source))}};
}

std::vector<std::string> correctionsOf(const PointFileInfo& info) {
  std::vector<std::string> all;
  for (const AppliedCorrection& correction : parseCorrections(info.corrections))
    all.push_back(correction.describe());
  return all;
}

const Fields<FileInventory>& inventoryFileFields() {
  using F = FileInventory;
  using I = PointFileInfo;
  static const Fields<I> info(
      "point_file", "What the header of a file states.",
      {{"path", [](const I& i) { return i.path.string(); }, "The file"},
       {"format", &I::format, "Its format"},
       {"crs", &I::crs, "Coordinate reference system, WKT or \"EPSG:…\"; empty: not known"},
       {"crs_ignored", &I::crs_ignored, "A stated one that cannot be used, and why"},
       {"units", unitsOf,
        "\"degrees\", or `horizontal` and `vertical`, each with its `name`, length in `metres`, "
        "and "
        "what it is `stated_by`"},
       {"time_kind", [](const I& i) { return timeKindName(i.time_kind); }, "How times count"},
       {"time_shift_s", &I::time_shift, "Added to the times that are stored"},
       {"corrections", correctionsOf, "Corrections that were applied to the points"},
       {"resolution", &I::resolution, "Steps of coordinates in the file", of("m")}});
  // The header and VLRs; the inventory has found what of the rest cannot be read.
  const auto las = [](const F& f) {
    return LasFile(f.info.path, kLazAllFields, LasDamage::keep_intact);
  };
  static const Fields<F> fields(
      "file", "A point file.",
      {Field<F>::all(&F::info, info),
       {"coordinate_steps", &F::steps, "Steps that coordinates have; 0: not known", of("m")},
       {"header_minimum", [](const F& f) { return f.info.minimum; }, "By the header", of("m")},
       {"header_maximum", [](const F& f) { return f.info.maximum; }, "By the header", of("m")},
       {"las", las, lasFields(), "Of LAS and LAZ files",
        onlyIf([](const F& f) { return f.info.format.rfind("LA", 0) == 0; })},
       {"statistics", &F::statistics, statisticsFields(), "Its points"},
       {"remarks", [](const F& f) { return textsOf(f.remarks); }, "Suspicious facts"}});
  return fields;
}

/// A strip, or an overlap of two, with the names of strips.
template <typename Item>
struct OfSurvey {
  const DatasetInventory* survey;
  const Item* item;
  const std::string& nameOf(std::size_t strip) const { return survey->strips[strip].id; }
};

template <typename Item>
auto listed(std::vector<Item> DatasetInventory::*member) {
  return [member](const DatasetInventory& survey) {
    std::vector<OfSurvey<Item>> all;
    for (const Item& item : survey.*member) all.push_back({&survey, &item});
    return all;
  };
}

std::optional<std::string> recordedWith(const OfSurvey<StripInventory>& strip) {
  if (!strip.item->recorded_with) return std::nullopt;
  return strip.nameOf(*strip.item->recorded_with);
}

std::vector<Eigen::Vector2d> gapsOf(const StripInventory& strip) {
  std::vector<Eigen::Vector2d> gaps;
  for (const TimeGap& gap : strip.gaps) gaps.emplace_back(gap.from, gap.to);
  return gaps;
}

const Fields<OfSurvey<StripInventory>>& listedStripFields() {
  using F = Field<OfSurvey<StripInventory>>;
  using I = StripInventory;
  const auto item = [](const auto& strip) -> const I& { return *strip.item; };
  static const Fields<I> points("strip_points", "Its points.",
                                {{"id", &I::id, "Name of the strip"},
                                 {"statistics", &I::statistics, statisticsFields(), "Its points"},
                                 {"density_per_m2", &I::density, "Median density of cells"},
                                 {"area_m2", &I::area, "Area of the cells with points"}});
  static const Fields<I> rest(
      "strip_remarks", "What was found.",
      {{"gaps", gapsOf, "Times without points: from, to", of("s")},
       {"remarks", [](const I& i) { return textsOf(i.remarks); }, "Suspicious facts"}});
  static const Fields<OfSurvey<StripInventory>> fields(
      "strip", "A strip.",
      {F::all(item, points),
       {"recorded_with", recordedWith, "A strip that was recorded at the same times"},
       F::all(item, rest)});
  return fields;
}

const Fields<DatasetInventory>& inventoryOverlapFields() {
  using O = OfSurvey<StripOverlap>;
  using S = DatasetInventory;
  static const Fields<O> overlap(
      "overlap", "Two strips that overlap.",
      {{"a", [](const O& o) { return o.nameOf(o.item->a); }, "First strip"},
       {"b", [](const O& o) { return o.nameOf(o.item->b); }, "Second strip"},
       {"area_m2", [](const O& o) { return o.item->area; }, "Area of the overlap"}});
  static const Fields<S> fields(
      "overlaps", "How strips overlap.",
      {{"overlaps", listed(&S::overlaps), overlap, "Overlaps; of at most 1000 strips"},
       {"area_m2_by_number_of_strips", &S::area_by_strips, "Area that 1, 2, … strips see",
        of("m²")},
       {"duplicates", &S::duplicates, "Points that are equal to another one"},
       {"duplicates_estimated", &S::duplicates_estimated, "Whether their number is estimated"},
       {"remarks", [](const S& s) { return textsOf(s.remarks); }, "Suspicious facts"}});
  return fields;
}

/// The content of the file.
struct InventoryReport {
  const DatasetInventory* survey;
  const std::vector<ExcludedPoints>* excluded;
  const ListedTrajectory* flight;
};

}  // namespace

const FieldTable& inventoryFields() {
  using F = Field<InventoryReport>;
  using R = InventoryReport;
  using S = DatasetInventory;
  static const Fields<S> parts("survey", "Files and strips.",
                               {{"cell_m", &S::cell, "Size of the cells of areas"},
                                {"files", &S::files, inventoryFileFields(), "Point files"},
                                {"strips", listed(&S::strips), listedStripFields(), "Strips"}});
  const auto survey = [](const R& r) -> const S& { return *r.survey; };
  static const Fields<R> fields(
      "info", "Result of `pcl_als_info`.",
      {F::constant("format", "pcl_als info", ""),
       F::constant("version", 1, ""),
       F::all(survey, parts),
       {"left_out", [](const R& r) { return *r.excluded; }, excludedFields(), "Points of no strip"},
       F::all(survey, inventoryOverlapFields()),
       F::all(
           [](const R& r) -> const auto& { return *r.flight; }, flightFields())});
  return fields;
}

std::string inventoryJson(const DatasetInventory& survey,
                          const std::vector<ExcludedPoints>& excluded,
                          const ListedTrajectory& flight) {
  const InventoryReport report{&survey, &excluded, &flight};
  return jsonText(inventoryFields().write(&report));
}

}  // namespace pcl_als
