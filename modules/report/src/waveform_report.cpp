// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/field_node.h>
#include <pcl_als/common/fields.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/report/waveform_report.h>

namespace pcl_als {
namespace {

using namespace field;

const Fields<WaveformCounts>& countFields() {
  using C = WaveformCounts;
  static const Fields<C> fields(
      "counts", "Numbers of points, waveforms and echoes.",
      {{"pulses", &C::pulses, "Pulses of a PulseWaves file"},
       {"points", &C::points, "Points of a LAS or LAZ file"},
       {"without_waveform", &C::without_waveform, "Points or pulses without a waveform"},
       {"waveforms", &C::waveforms, "Waveforms"},
       {"single", &C::single, "Waveforms with one echo"},
       {"saturated", &C::saturated, "Waveforms with saturated samples"},
       {"echoes", &C::echoes, "Echoes"},
       {"matched", &C::matched, "Points that an echo belongs to"},
       {"unmatched", &C::unmatched, "Points with a waveform that no echo belongs to"},
       {"added", &C::added, "Echoes that no point belongs to"},
       {"mean_offset_ps", &C::meanOffset, "Echoes behind their points, mean"},
       {"uncovered", &C::uncovered, "Waveforms without a range, of a run with cross sections"},
       {"attenuated", &C::attenuated, "Echoes that were corrected for attenuation"},
       {"opaque", &C::opaque, "Those of them with the least transmission"}});
  return fields;
}

const Fields<CrossSectionResult>& sectionFields() {
  using C = CrossSectionResult;
  static const Fields<C> fields(
      "cross_sections", "Cross sections by the radar equation.",
      {{"calibration_constant", &C::constant, "In m2 / (count ns km4)"},
       {"calibrated", &C::calibrated, "Otherwise cross sections are relative"},
       {"relative_std",
        [](const C& c) {
          return c.reference ? std::optional(c.reference->relative_std) : std::nullopt;
        },
        "Of the constant, from targets"},
       {"full_coefficient", &C::full_coefficient,
        "Backscatter coefficient of a whole pulse; 0: no correction of attenuation"}});
  return fields;
}

/// The response that was used.
const Fields<WaveformResult>& responseFields() {
  using R = WaveformResult;
  static const Fields<R> fields(
      "response", "Response of the system to a point target, with its maximum at the time 0.",
      {{"spacing_ns", &R::pulse_spacing_ns, "Of its values"},
       {"first_ns", &R::pulse_first_ns, "Time of the first value"},
       {"values", &R::pulse, "Values; the largest is 1"}});
  return fields;
}

std::vector<std::string> remarksOf(const WaveformReport& report) {
  return report.result->remarks;
}

void checkLengths(const WaveformExample& waveform, const FieldNode& node) {
  if (waveform.samples.empty()) node["samples"].refuse("has no values");
  if (waveform.model.size() != (waveform.samples.size() - 1) * WaveformExample::kModelValues + 1)
    node["model"].refuse("must have four values for each sample but the last");
}

}  // namespace

const Fields<WaveformExample>& waveformExampleFields() {
  using W = WaveformExample;
  using E = W::Echo;
  static const Fields<E> echoes(
      "echo", "An echo.",
      {{"time_ns", &E::time, "From the first sample"},
       {"time_std_ns", &E::time_std, "Standard deviation"},
       {"amplitude", &E::amplitude, "Digitizer counts"},
       {"amplitude_std", &E::amplitude_std, "Standard deviation"},
       {"width_ns", &E::width, "Full width at half maximum"},
       {"width_std_ns", &E::width_std, "Standard deviation"},
       {"new_echo", &E::new_echo, "Whether no return of the scanner belongs to it"}});
  static const Fields<W> fields =
      Fields<W>(
          "decomposed_waveform", "A waveform and its echoes.",
          {{"number", &W::number, "Of its point, or of its pulse in a PulseWaves file, from 0"},
           {"descriptor", &W::descriptor, "Index of its descriptor"},
           {"spacing_ns", &W::spacing, "Of its samples"},
           {"baseline", &W::baseline, "Digitizer counts"},
           {"baseline_std", &W::baseline_std, "Standard deviation"},
           {"noise", &W::noise, "Standard deviation of a sample"},
           {"largest_residual", &W::largest_residual, "Over the noise"},
           {"samples", &W::samples, "Digitizer counts"},
           {"model", &W::model, "Adjusted waveform, four values for each sample"},
           {"echoes", &W::echoes, echoes, "Echoes by time"},
           {"returns_ns", &W::returns, "Times of the discrete returns"}})
          .checked(&checkLengths);
  return fields;
}

const FieldTable& waveformFields() {
  using R = WaveformReport;
  using F = Field<R>;
  using P = UsedPulse;
  static const Fields<P> pulses("pulse", "Response that was used for a descriptor.",
                                {{"descriptor", &P::descriptor, "Index of the descriptor"},
                                 {"width_ns", &P::width_ns, "Full width at half maximum"},
                                 {"origin", &P::origin, "Where it is from"}});
  const auto result = [](const R& r) -> const auto& {
    return *r.result;
  };
  static const Fields<R> fields(
      "waveform", "Result of `pcl_als_waveform`.",
      {F::constant("format", "pcl_als waveform", ""),
       F::constant("version", 1, ""),
       {"counts", [](const R& r) { return r.result->counts; }, countFields(),
        "Numbers of points, waveforms and echoes"},
       {"pulses", [](const R& r) { return r.result->pulses; }, pulses, "Responses by descriptor"},
       {"response", result, responseFields(), "The response of most waveforms"},
       {"cross_sections", [](const R& r) { return r.result->cross_sections; }, sectionFields(),
        "Cross sections; null: without them"},
       {"waveforms", [](const R& r) { return r.result->examples; }, waveformExampleFields(),
        "Waveforms that were asked for, or examples"},
       {"warnings", remarksOf, "What a user should know"},
       {"input", &R::input, "File with the waveforms"},
       {"output", &R::output, "File with the echoes"},
       toolVersionField<R>()});
  return fields;
}

std::string waveformJson(const WaveformReport& report) {
  return jsonText(waveformFields().write(&report));
}

}  // namespace pcl_als
