// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "waveform_echoes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_rewriter.h>

namespace pcl_als::detail {
namespace {

constexpr std::uint8_t kUnclassified = 1;
constexpr std::size_t kReturnsAt = 14, kFlagsAt = 15;
/// The order of the fields in the records.
enum Field : std::size_t {
  kAmplitude,
  kWidth,
  kWidthStd,
  kRangeStd,
  kSaturated,
  kNew,
  kSection,
  kCoefficient
};

LasExtraField fieldOf(const char* name, const char* description, LasExtraType type) {
  LasExtraField field;
  field.name = name;
  field.description = description;
  field.type = type;
  return field;
}

bool hasField(const LasFile& las, const std::string& name) {
  const auto& there = las.extraFields();
  return std::any_of(there.begin(), there.end(),
                     [&name](const LasExtraField& field) { return field.name == name; });
}

/// Flags a record as synthetic (LAS 1.4 R15: also a point that was found in a waveform).
void flagSynthetic(const LasRecordLayout& layout, std::byte* record) {
  record[kFlagsAt] |= layout.extended ? std::byte{1} : std::byte{0x20};
}

void storeReturns(const LasRecordLayout& layout, unsigned number, unsigned of, std::byte* record) {
  std::byte& at = record[kReturnsAt];
  if (layout.extended)
    at = static_cast<std::byte>(number | of << 4U);
  else
    at = (at & std::byte{0xC0}) | static_cast<std::byte>(number | of << 3U);
}

std::int32_t rounded(double value, const std::string& name) {
  constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
  if (!(std::abs(value) < kLargest))
    throw InputError(name + "an echo of its waveform is too far away to be stored");
  return static_cast<std::int32_t>(std::lround(value));
}

}  // namespace

std::vector<LasExtraField> echoAttributeFields() {
  return {fieldOf("amplitude", "of the echo, digitizer counts", LasExtraType::f32),
          fieldOf("echo_width", "full width at half maximum, ns", LasExtraType::f32),
          fieldOf("echo_width_std", "standard deviation, ns", LasExtraType::f32),
          fieldOf("range_std", "of the echo, m", LasExtraType::f32),
          fieldOf("number_of_samples_saturated", "of the echo", LasExtraType::u16),
          fieldOf("new_echo", "1: no return of the scanner", LasExtraType::u8)};
}

void storeEchoAttributes(const EchoAttributes& echo, const std::vector<LasExtraField>& fields,
                         std::byte* record) {
  storeLas(record + fields[kAmplitude].position, echo.amplitude);
  storeLas(record + fields[kWidth].position, echo.echo_width);
  storeLas(record + fields[kWidthStd].position, echo.echo_width_std);
  storeLas(record + fields[kRangeStd].position, echo.range_std);
  storeLas(record + fields[kSaturated].position, echo.saturated);
  storeLas(record + fields[kNew].position, static_cast<std::uint8_t>(echo.new_echo ? 1 : 0));
}

EchoFields::EchoFields(const LasFile& las, const EchoCrossSections* cross_sections) {
  std::vector<LasExtraField> wanted = echoAttributeFields();
  if (cross_sections != nullptr) {
    const bool calibrated = cross_sections->result().calibrated;
    wanted.push_back(fieldOf("cross_section",
                             calibrated ? "of the echo, m2" : "relative, constant 1",
                             LasExtraType::f32));
    wanted.push_back(fieldOf("backscatter_coefficient",
                             calibrated ? "over the area of the beam" : "relative, constant 1",
                             LasExtraType::f32));
  }
  for (LasExtraField& field : wanted) {
    const std::string name = field.name;
    for (int n = 2; hasField(las, field.name); ++n) field.name = name + '_' + std::to_string(n);
  }
  fields = placeExtension(las, wanted);
  record_length = fields.back().position + fields.back().size;
}

void EchoFields::store(const EchoAttributes& echo, std::byte* record) const {
  storeEchoAttributes(echo, fields, record);
}

void EchoFields::storeSection(float cross_section, float coefficient, std::byte* record) const {
  if (fields.size() <= kCoefficient) return;
  storeLas(record + fields[kSection].position, cross_section);
  storeLas(record + fields[kCoefficient].position, coefficient);
}

EchoWriter::EchoWriter(const EchoJob& job)
    : job_(job), reader_(job.source), echoes_(job.responses, job.settings) {}

std::byte* EchoWriter::addRecord(const std::byte* record, std::vector<std::byte>& records) {
  const std::size_t at = records.size();
  records.resize(at + job_.fields.record_length);
  std::memcpy(&records[at], record, job_.las.header().record_length);
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  job_.fields.store(EchoAttributes(), &records[at]);
  job_.fields.storeSection(kNothing, kNothing, &records[at]);
  return &records[at];
}

void EchoWriter::storeEcho(int echo, const WaveformReference& own, std::byte* record) const {
  const Eigen::Vector3d metres_per_unit =
      job_.metres.scale.cwiseQuotient(job_.las.header().scale).cwiseAbs();
  const double speed = own.alongPulse().cwiseProduct(metres_per_unit).norm();
  job_.fields.store(echoes_.attributesOf(echo, speed), record);
  if (!sections_.covered) return;
  const auto at = static_cast<std::size_t>(echo);
  job_.fields.storeSection(static_cast<float>(sections_.cross_section[at]),
                           static_cast<float>(sections_.coefficient[at]), record);
}

void EchoWriter::findSections(const WaveformPulse& pulse, WaveformCounts& counts) {
  if (job_.cross_sections == nullptr) return;
  job_.cross_sections->evaluate(pulse, echoes_, node_, sections_);
  if (pulse.repeated) return;
  counts.uncovered += sections_.covered ? 0 : 1;
  if (!sections_.covered) return;
  for (const double transmission : sections_.transmission) {
    counts.attenuated += transmission < 1.0 ? 1 : 0;
    counts.opaque += transmission <= CrossSectionResult::kLeastTransmission ? 1 : 0;
  }
}

/// Moves a record along its pulse to a time of its waveform.
void EchoWriter::moveTo(double time_ps, const WaveformReference& own, std::uint64_t point,
                        std::byte* record) const {
  const std::string name = job_.las.path().string() + ": point " + std::to_string(point) + ": ";
  const Eigen::Vector3d shift = (time_ps - static_cast<double>(own.location_ps)) * own.alongPulse();
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = shift[axis] / job_.las.header().scale[axis];
    const double moved = LasRecordLayout::coordinateOf(record, axis) + steps;
    LasRecordLayout::storeCoordinate(rounded(moved, name), axis, record);
  }
  WaveformReference changed = own;
  changed.location_ps = static_cast<float>(time_ps);
  changed.store(record, job_.las.layout());
}

/// Echoes that no point belongs to. The intensity is in proportion to the amplitude, as that of the
/// point beside it.
void EchoWriter::addEchoes(const WaveformPulse& pulse, std::vector<std::byte>& records) {
  constexpr double kLargestIntensity = 65535.0;
  for (int e = 0; e < echoes_.count(); ++e) {
    if (echoes_.returnOf(e) >= 0) continue;
    const std::size_t p = echoes_.nearestReturn(e);
    const std::byte* beside = pulse.records + p * job_.las.header().record_length;
    const WaveformReference own = WaveformReference::of(beside, job_.las.layout());
    std::byte* record = addRecord(beside, records);
    storeEcho(e, own, record);
    moveTo(echoes_.timeOf(e), own, pulse.first + p, record);
    flagSynthetic(job_.las.layout(), record);
    job_.las.layout().storeClass(kUnclassified, record);
    const double intensity = LasRecordLayout::intensityOf(beside) * echoes_.intensityRatio(e);
    LasRecordLayout::storeIntensity(
        static_cast<std::uint16_t>(std::lround(std::clamp(intensity, 0.0, kLargestIntensity))),
        record);
  }
}

/// Numbers the returns of a pulse by their times, if all of them are here.
void EchoWriter::renumber(const WaveformPulse& pulse, std::size_t begin,
                          std::vector<std::byte>& records) const {
  const LasRecordLayout& layout = job_.las.layout();
  if (layout.numberOfReturnsOf(pulse.records) != pulse.count) return;
  const std::size_t length = job_.fields.record_length;
  const std::size_t count = (records.size() - begin) / length;
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i)
    times.push_back(WaveformReference::of(&records[begin + i * length], layout).location_ps);
  const std::vector<unsigned> numbers = numbersByTime(times);
  const unsigned most = layout.extended ? 15 : 7;
  for (std::size_t i = 0; i < count; ++i)
    storeReturns(layout, std::min(numbers[i], most), std::min(static_cast<unsigned>(count), most),
                 &records[begin + i * length]);
}

/// \return false if the pulse has no waveform
bool EchoWriter::findEchoes(const WaveformPulse& pulse) {
  if (!reader_.read(pulse.records, pulse.first, waveform_)) return false;
  const std::size_t length = job_.las.header().record_length;
  locations_.clear();
  for (std::size_t p = 0; p < pulse.count; ++p)
    locations_.push_back(
        WaveformReference::of(pulse.records + p * length, job_.las.layout()).location_ps);
  echoes_.decompose(waveform_, locations_);
  return true;
}

std::optional<WaveformExample> EchoWriter::example(const WaveformPulse& pulse,
                                                   std::uint64_t number) {
  if (!findEchoes(pulse)) return std::nullopt;
  return echoes_.example(number);
}

void EchoWriter::append(const WaveformPulse& pulse, std::vector<std::byte>& records,
                        WaveformCounts& counts) {
  const std::size_t begin = records.size(), length = job_.las.header().record_length;
  counts.points += pulse.count;
  if (!findEchoes(pulse)) {
    counts.without_waveform += pulse.count;
    for (std::size_t p = 0; p < pulse.count; ++p) addRecord(pulse.records + p * length, records);
    return;
  }
  findSections(pulse, counts);
  for (std::size_t p = 0; p < pulse.count; ++p) {
    const std::byte* given = pulse.records + p * length;
    std::byte* record = addRecord(given, records);
    const int echo = echoes_.echoOf(p);
    if (echo < 0) continue;
    const WaveformReference own = WaveformReference::of(given, job_.las.layout());
    const double time = echoes_.timeOf(echo);
    storeEcho(echo, own, record);
    ++counts.matched;
    counts.sum_offset_ps += time - locations_[p];
    if (job_.settings.move_returns) moveTo(time, own, pulse.first + p, record);
  }
  const bool adds = job_.settings.new_echoes && !pulse.repeated;
  if (adds) addEchoes(pulse, records);
  const std::size_t written = (records.size() - begin) / job_.fields.record_length;
  if (written > pulse.count) renumber(pulse, begin, records);
  counts.added += written - pulse.count;
  if (pulse.repeated) return;
  ++counts.waveforms;
  counts.echoes += static_cast<std::uint64_t>(echoes_.found().count);
  counts.single += echoes_.found().count == 1 ? 1 : 0;
  counts.saturated += echoes_.found().saturated > 0 ? 1 : 0;
}

}  // namespace pcl_als::detail
