// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pulse_waves_records.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/las_record.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kText = 64;  // bytes of texts in records, the last part of each
constexpr std::size_t kComposition = 92, kSampling = 104, kScanner = 248;
constexpr std::size_t kTables = 76, kTable = 84;  // bytes before the entries
constexpr std::uint32_t kNoConstant = 0x8FFFFFFF;
constexpr unsigned kFloat = 8;        // data type of entries
constexpr double kLongestUnit = 1e6;  // nanoseconds
constexpr double kLeastUnit = 1e-3;

bool isPositive(double value) {
  return std::isfinite(value) && value > 0.0;
}

/// The bytes of a part of a record from \a at, which begins with its size.
const std::byte* part(const std::vector<std::byte>& bytes, std::size_t at, std::size_t least,
                      const std::string& what, std::size_t& size) {
  size = bytes.size() - at < 4 ? 0 : loadLas<std::uint32_t>(&bytes[at]);
  if (size < least || size > bytes.size() - at)
    throw InputError(what + " has " + std::to_string(size) + " bytes; at least " +
                     std::to_string(least) + " are needed, and its record has " +
                     std::to_string(bytes.size() - at) + " for it");
  return &bytes[at];
}

bool isOneOf(unsigned value, std::initializer_list<unsigned> values) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// The first fault of a sampling; empty if there is none.
std::string faultOf(const PulseSampling& s, unsigned type, std::uint32_t compression) {
  if (type > 2) return "the type " + std::to_string(type) + "; 1 and 2 are defined";
  if (compression != 0)
    return "compressed samples (type " + std::to_string(compression) + "), which cannot be read";
  if (!isOneOf(s.bits, {8, 16}))
    return counted(s.bits, "bit") + " per sample; the format has 8 and 16";
  if (!isOneOf(s.duration_bits, {0, 8, 16, 32}))
    return counted(s.duration_bits, "bit") + " for durations; the format has 0, 8, 16 and 32";
  if (!isOneOf(s.segment_bits, {0, 8, 16}) || !isOneOf(s.sample_bits, {0, 8, 16}))
    return "numbers of segments or samples of " + counted(s.segment_bits, "bit") + " and " +
           counted(s.sample_bits, "bit") + "; the format has 0, 8 and 16";
  if (!isPositive(s.spacing_ns) || s.spacing_ns < kLeastUnit || s.spacing_ns > kLongestUnit)
    return "a time of " + shortText(s.spacing_ns) + " ns between samples";
  if (s.duration_bits > 0 && (!isPositive(s.duration_scale) || !std::isfinite(s.duration_offset)))
    return "a scale or offset of durations that is no number";
  if (s.sample_bits == 0 && s.samples == 0) return "segments without samples";
  if (s.duration_bits == 0 && s.segment_bits == 0 && s.segments > 1)
    return counted(s.segments, "segment") + " that all begin at the anchor";
  return {};
}

PulseSampling parseSampling(const std::byte* at, std::size_t size, const std::string& name) {
  PulseSampling s;
  const auto type = std::to_integer<unsigned>(at[8]);
  s.type = static_cast<PulseSampling::Type>(std::min(type, 2U));
  s.channel = std::to_integer<unsigned>(at[9]);
  s.duration_bits = std::to_integer<unsigned>(at[11]);
  s.duration_scale = loadLas<float>(at + 12);
  s.duration_offset = loadLas<float>(at + 16);
  s.segment_bits = std::to_integer<unsigned>(at[20]);
  s.sample_bits = std::to_integer<unsigned>(at[21]);
  s.segments = loadLas<std::uint16_t>(at + 22);
  s.samples = loadLas<std::uint32_t>(at + 24);
  s.bits = loadLas<std::uint16_t>(at + 28);
  s.table = loadLas<std::uint16_t>(at + 30);
  s.spacing_ns = loadLas<float>(at + 32);
  s.description = pulseText(at + size - kText, kText);
  const std::string fault = faultOf(s, type, loadLas<std::uint32_t>(at + 36));
  if (!fault.empty()) throw InputError(name + " describes " + fault);
  return s;
}

void requireNumbers(const PulseWavesHeader& h, const std::string& name) {
  const bool scales = h.scale.array().isFinite().all() && (h.scale.array() > 0.0).all();
  if (!scales || !h.offset.allFinite())
    throw InputError(name + ": the scale or offset of its coordinates is no number");
  if (!isPositive(h.time_scale) || !std::isfinite(h.time_offset))
    throw InputError(name + ": the scale or offset of its times is no number");
}

void requirePulses(const PulseWavesHeader& h, std::uint64_t file_size, const std::string& name) {
  const std::size_t attributes = (h.attributes & 1U) * 2 + (h.attributes >> 1U & 1U) * 4;
  if (h.record_length < kPulseRecord + attributes)
    throw InputError(name + ": its pulses have " + std::to_string(h.record_length) +
                     " bytes; pulse format 0 with their attributes has " +
                     std::to_string(kPulseRecord + attributes));
  if (h.header_size < kPulseHeader || h.pulse_offset < h.header_size || h.pulse_offset > file_size)
    throw InputError(name + ": its header states " + std::to_string(h.header_size) +
                     " bytes of header and pulses of " + std::to_string(h.record_length) +
                     " bytes from byte " + std::to_string(h.pulse_offset));
  const std::uint64_t room = (file_size - h.pulse_offset) / h.record_length;
  if (h.pulse_count > room)
    throw InputError(name + ": its header states " + grouped(h.pulse_count) +
                     " pulses, and the file has room for " + grouped(room) + "; it is truncated");
}

}  // namespace

std::string pulseText(const std::byte* at, std::size_t size) {
  const char* text = reinterpret_cast<const char*>(at);
  return std::string(text, std::find(text, text + size, '\0'));
}

PulseWavesHeader parsePulseHeader(const std::byte* at, std::uint64_t file_size,
                                  const std::string& name) {
  PulseWavesHeader h;
  h.file_source_id = loadLas<std::uint32_t>(at + 20);
  h.system_id = pulseText(at + 40, kText);
  h.generating_software = pulseText(at + 104, kText);
  h.version_major = std::to_integer<int>(at[172]);
  h.version_minor = std::to_integer<int>(at[173]);
  h.header_size = loadLas<std::uint16_t>(at + 174);
  h.pulse_offset = loadLas<std::uint64_t>(at + 176);
  h.pulse_count = loadLas<std::uint64_t>(at + 184);
  h.attributes = loadLas<std::uint32_t>(at + 196);
  h.record_length = loadLas<std::uint32_t>(at + 200);
  h.vlr_count = loadLas<std::uint32_t>(at + 216);
  h.avlr_count = loadLas<std::int32_t>(at + 220);
  h.time_scale = loadLas<double>(at + 224);
  h.time_offset = loadLas<double>(at + 232);
  for (int axis = 0; axis < 3; ++axis) {
    h.scale[axis] = loadLas<double>(at + 256 + 8 * axis);
    h.offset[axis] = loadLas<double>(at + 280 + 8 * axis);
    h.minimum[axis] = loadLas<double>(at + 304 + 16 * axis);
    h.maximum[axis] = loadLas<double>(at + 312 + 16 * axis);
  }
  const auto format = loadLas<std::uint32_t>(at + 192), packing = loadLas<std::uint32_t>(at + 204);
  if (packing != 0)
    throw InputError(name + ": compressed pulses cannot be read; decompress them to .pls and .wvs");
  if (format != 0)
    throw InputError(name + ": its pulses have format " + std::to_string(format) +
                     "; only format 0 is defined");
  requireNumbers(h, name);
  requirePulses(h, file_size, name);
  return h;
}

PulseDescriptor parsePulseDescriptor(const std::vector<std::byte>& bytes, const std::string& name) {
  std::size_t size = 0;
  const std::byte* at = part(bytes, 0, kComposition, name + ": the composition", size);
  PulseDescriptor d;
  const auto centre = loadLas<std::uint32_t>(at + 8);
  if (centre != kNoConstant) d.centre_to_anchor = static_cast<std::int32_t>(centre);
  d.extra_bytes = loadLas<std::uint16_t>(at + 12);
  const unsigned samplings = loadLas<std::uint16_t>(at + 14);
  d.unit_ns = loadLas<float>(at + 16);
  d.scanner = loadLas<std::uint32_t>(at + 24);
  d.description = pulseText(at + size - kText, kText);
  if (samplings == 0) throw InputError(name + " has no samplings");
  if (loadLas<std::uint32_t>(at + 20) != 0)
    throw InputError(name + " describes compressed waves, which cannot be read");
  if (!isPositive(d.unit_ns) || d.unit_ns < kLeastUnit || d.unit_ns > kLongestUnit)
    throw InputError(name + " describes a sampling unit of " + shortText(d.unit_ns) + " ns");
  std::size_t position = size;
  for (unsigned i = 0; i < samplings; ++i, position += size) {
    const std::string sampling = name + ": sampling " + std::to_string(i);
    const std::byte* own = part(bytes, position, kSampling, sampling, size);
    d.samplings.push_back(parseSampling(own, size, sampling));
  }
  return d;
}

PulseScanner parsePulseScanner(const std::vector<std::byte>& bytes, const std::string& name) {
  std::size_t size = 0;
  const std::byte* at = part(bytes, 0, kScanner, name, size);
  PulseScanner s;
  s.instrument = pulseText(at + 8, kText);
  s.serial = pulseText(at + 72, kText);
  s.description = pulseText(at + size - kText, kText);
  s.wavelength_nm = loadLas<float>(at + 136);
  s.pulse_width_ns = loadLas<float>(at + 140);
  s.pattern = loadLas<std::uint32_t>(at + 144);
  s.facets = loadLas<std::uint32_t>(at + 148);
  float* const numbers[] = {&s.scan_frequency_hz,   &s.least_angle_deg,  &s.largest_angle_deg,
                            &s.pulse_frequency_khz, &s.beam_diameter_mm, &s.divergence_mrad,
                            &s.least_range,         &s.largest_range};
  for (std::size_t i = 0; i < 8; ++i) *numbers[i] = loadLas<float>(at + 152 + 4 * i);
  return s;
}

std::vector<SampleTable> parseSampleTables(const std::vector<std::byte>& bytes,
                                           const std::string& name) {
  std::size_t size = 0;
  const auto count = loadLas<std::uint32_t>(part(bytes, 0, kTables, name, size) + 8);
  std::vector<SampleTable> tables;
  std::size_t position = size;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string own = name + ": lookup table " + std::to_string(i);
    const std::byte* at = part(bytes, position, kTable, own, size);
    position += size;
    const auto entries = loadLas<std::uint32_t>(at + 8);
    if (std::to_integer<unsigned>(at[14]) != kFloat || loadLas<std::uint32_t>(at + 16) != 0)
      throw InputError(own + " has a data type or a compression that the format does not define");
    if (entries > (bytes.size() - position) / sizeof(float))
      throw InputError(own + " has " + grouped(entries) +
                       " entries and reaches past the end of its record");
    SampleTable table;
    table.unit = loadLas<std::uint16_t>(at + 12);
    table.description = pulseText(at + size - kText, kText);
    for (std::uint32_t k = 0; k < entries; ++k, position += sizeof(float))
      table.entries.push_back(loadLas<float>(bytes.data() + position));
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace pcl_als::detail
