// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iomanip>
#include <sstream>

#include <pcl_als/common/parameter_text.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/report/plan_report.h>

namespace pcl_als {
namespace {

using namespace field;

void lineTable(const FlightPlanResult& result, std::ostream& out) {
  out << "| line       | height m | course deg | length m | time s | swath m | per m2 |\n"
      << "|------------|----------|------------|----------|--------|---------|--------|\n"
      << std::fixed;
  for (const StripGeometry& line : result.lines) {
    out << "| " << std::left << std::setw(10) << line.id << std::right << std::setprecision(0)
        << " | " << std::setw(8) << line.height << " | " << std::setw(10)
        << line.course() / kRadiansPerDegree << " | " << std::setw(8) << line.length() << " | "
        << std::setw(6) << line.duration() << " | " << std::setw(7) << 2.0 * line.halfSwath()
        << " | " << std::setprecision(2) << std::setw(6) << line.density << " |\n";
  }
}

void parameterTable(const FlightPlanResult& result, std::ostream& out) {
  out << "\nStandard deviations to expect\n\n"
      << "| parameter          |          std | unit   | status         |\n"
      << "|--------------------|--------------|--------|----------------|\n";
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result.expected[info.parameter];
    out << "| " << std::left << std::setw(18) << info.name << std::right << " | ";
    if (estimate.status == ParameterStatus::estimated) {
      const int digits = tableDecimals(info.parameter);
      out << std::setprecision(digits) << std::setw(12) << estimate.std / info.internal_per_unit;
    } else {
      out << "           -";
    }
    out << " | " << std::left << std::setw(6) << info.unit << " | " << std::setw(14)
        << toString(estimate.status) << std::right << " |\n";
  }
}

const Fields<StripGeometry>& plannedLineFields() {
  using L = StripGeometry;
  static const Fields<L> fields(
      "line", "A flight line: straight, level, at constant speed.",
      {{"id", &L::id, "Name of the line"},
       {"start_m", &L::start, "Its start: east, north"},
       {"end_m", &L::end, "Its end"},
       {"height_m", &L::height, "Height above the mean ground"},
       {"course_deg", &L::course, "Course, clockwise from grid north", in(kRadiansPerDegree)},
       {"length_m", &L::length, "Length"},
       {"duration_s", &L::duration, "Flying time"},
       {"speed_m_s", &L::speed, "Speed", of("m/s")},
       {"field_of_view_deg", [](const L& l) { return 2.0 * l.half_angle; }, "Field of view",
        in(kRadiansPerDegree)},
       {"density_per_m2", &L::density, "Pulses on the ground"}});
  return fields;
}

Fields<ParameterEstimate> expectedFields(const SystemParameterInfo& info) {
  using P = ParameterEstimate;
  return {"parameter_" + std::string(info.unit),
          "What the flight will determine of a parameter.",
          {{"std", &P::std, "Standard deviation", in(info.internal_per_unit), of(info.unit),
            knownIf([](const P& p) { return p.status == ParameterStatus::estimated; })},
           unitField<P>(info.unit),
           {"status", &P::status, parameterStatusNames(), "Whether it will be estimated"},
           {"reason", &P::reason, "Why not", unlessEmpty}}};
}

const Fields<CalibrationResult>& expectedParametersFields() {
  using R = CalibrationResult;
  static const auto fields =
      fieldsByParameter<R>("parameters", "System parameters.", [](const SystemParameterInfo& info) {
        const SystemParameter p = info.parameter;
        const auto estimate = [p](const R& r) -> const ParameterEstimate& { return r[p]; };
        return Field<R>(std::string(info.name), estimate, expectedFields(info), "");
      });
  return fields;
}

const Fields<Advice>& adviceFields() {
  using A = Advice;
  static const Fields<A> fields(
      "advice", "A line or control that would help.",
      {{"text", &A::text, "The line or control and its benefit"},
       {"benefit", &A::benefit, "Sum of ln(std before / std after)"},
       {"line", &A::line, plannedLineFields(), "The line", onlyIf(&A::is_line)},
       {"control_m", &A::control, "Places of the control: east, north",
        onlyIf([](const A& a) { return !a.is_line; })},
       {"std_before", &A::before, deviationFields(), "Standard deviations without it"},
       {"std_after", &A::after, deviationFields(), "And with it"}});
  return fields;
}

std::vector<std::string> parameterNamesOf(const std::vector<SystemParameter>& parameters) {
  std::vector<std::string> names;
  for (const SystemParameter p : parameters) names.emplace_back(infoOf(p).name);
  return names;
}

const Fields<ObservabilityReport>& observabilityFields() {
  using O = ObservabilityReport;
  using W = WeakCombination;
  static const Fields<W> weak(
      "weak", "Parameters that cannot be separated, or one that is hardly determined.",
      {{"parameters", [](const W& w) { return parameterNamesOf(w.parameters); }, "Their names"},
       {"correlation", &W::correlation, "Correlation of two"},
       {"cause", &W::cause, "What it is due to; empty: not known"},
       {"text", &W::text, "The same as a sentence"}});
  static const Fields<ParameterDirection> direction(
      "direction", "A combination of parameters.",
      {{"std_on_ground_m", &ParameterDirection::std, "Its effect on the ground"},
       {"text", &ParameterDirection::text, "The same as a sentence"}});
  static const Fields<O> fields("observability",
                                "What is weakly determined, why, and what would help.",
                                {{"block", &O::facts, "The block in words"},
                                 {"weak", &O::weak, weak, "Weakest first"},
                                 {"directions", &O::directions, direction, "Weakest first"},
                                 {"advice", &O::advice, adviceFields(), "Best first"},
                                 {"cheapest_line", [](const O& o) { return *o.cheapestLine(); },
                                  adviceFields(), "Largest benefit for its flying time",
                                  onlyIf([](const O& o) { return o.cheapestLine() != nullptr; })}});
  return fields;
}

const Fields<FlightPlanResult>& planResultFields() {
  using O = FlightPlanResult::Overlap;
  using R = FlightPlanResult;
  static const Fields<CalibrationResult> correlation(
      "correlation", "Expected correlations.",
      {{"order", [](const auto& c) { return parameterNamesOf(c.correlation_order); },
        "The parameters"},
       {"matrix", &CalibrationResult::correlation, "Correlations, in this order"}});
  static const Fields<O> pair(
      "pair", "Two lines that overlap.",
      {{"a", &O::a, "First line"},
       {"b", &O::b, "Second line"},
       {"areas", &O::areas, "Areas of comparison"},
       {"correspondences", [](const O& o) { return std::llround(o.pairs); }, "Expected number"}});
  static const Fields<R> fields(
      "plan_result", "What the flight will give.",
      {{"determined", [](const R& r) { return r.expected.converged; },
        "Whether all requested parameters will be determined"},
       {"parameters", &R::expected, expectedParametersFields(), "System parameters"},
       {"correlation", &R::expected, correlation, "Expected correlations"},
       {"lines", &R::lines, plannedLineFields(), "The lines"},
       {"pairs", &R::overlaps, pair, "Overlaps"},
       {"control_points", &R::control_points, "Control points that a line covers"},
       {"observability", &R::observability, observabilityFields(), "What would help"},
       {"warnings", [](const R& r) { return textsOf(r.expected.warnings); },
        "What a user should know"}});
  return fields;
}

/// The content of plan.json.
struct PlanReport {
  const FlightPlanResult* result;
  const std::vector<std::string>* inputs;
};

}  // namespace

std::string planTables(const FlightPlanResult& result) {
  std::ostringstream out;
  lineTable(result, out);
  parameterTable(result, out);
  for (const Warning& warning : result.expected.warnings) out << "\nwarning: " << warning.text;
  out << (result.expected.warnings.empty() ? "\n" : "\n\n");
  for (const std::string& text : result.observability.text()) out << text << '\n';
  if (const Advice* cheapest = result.observability.cheapestLine()) {
    out << "most for its flying time: " << cheapest->what << '\n';
  }
  return out.str();
}

const FieldTable& planFields() {
  using F = Field<PlanReport>;
  using R = PlanReport;
  static const Fields<R> fields(
      "plan", "Result of `pcl_als_plan`.",
      {F::constant("format", "pcl_als plan", ""),
       F::constant("version", 1, ""),
       F::all(
           [](const R& r) -> const auto& { return *r.result; }, planResultFields()),
       {"inputs", [](const R& r) { return *r.inputs; }, "Files of the plan"},
       toolVersionField<R>()});
  return fields;
}

std::string planJson(const FlightPlanResult& result, const std::vector<std::string>& inputs) {
  const PlanReport report{&result, &inputs};
  return jsonText(planFields().write(&report));
}

std::string notDetermined(const CalibrationResult& expected) {
  std::string why;
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = expected[info.parameter];
    if (estimate.status != ParameterStatus::not_estimable) continue;
    why += (why.empty() ? "" : "; ") + std::string(info.name) + " will not be determined (" +
           estimate.reason + ")";
  }
  return why;
}

}  // namespace pcl_als
