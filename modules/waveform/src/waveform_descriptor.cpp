// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/waveform/waveform_descriptor.h>

namespace pcl_als {
namespace {

constexpr unsigned kFirstRecord = 100, kLastRecord = 354, kRecordOfIndexZero = 99;
constexpr std::size_t kDescriptorBytes = 26;
constexpr unsigned kFewestBits = 2, kMostBits = 32;

bool isDescriptor(const LasVlrEntry& vlr) {
  return vlr.user_id == kLasSpecUser && vlr.record_id >= kFirstRecord &&
         vlr.record_id <= kLastRecord;
}

/// The first fault of a descriptor; empty if there is none.
std::string faultOf(const WaveformDescriptor& d, unsigned compression) {
  if (d.bits < kFewestBits || d.bits > kMostBits)
    return counted(d.bits, "bit") + " per sample; the specification allows 2 to 32";
  if (compression != 0)
    return "packets of compression type " + std::to_string(compression) +
           ", which the specification does not define";
  if (d.spacing_ps == 0) return "a time of 0 ps between samples";
  if (!std::isfinite(d.gain) || d.gain == 0.0)
    return "a digitizer gain of " + shortText(d.gain) + "; a number other than zero is needed";
  if (!std::isfinite(d.offset)) return "a digitizer offset that is no number";
  return {};
}

WaveformDescriptor parseDescriptor(const std::vector<std::byte>& bytes, const std::string& name) {
  if (bytes.size() < kDescriptorBytes)
    throw InputError(name + " has " + std::to_string(bytes.size()) + " bytes instead of " +
                     std::to_string(kDescriptorBytes));
  WaveformDescriptor d;
  d.bits = std::to_integer<unsigned>(bytes[0]);
  d.samples = loadLas<std::uint32_t>(&bytes[2]);
  d.spacing_ps = loadLas<std::uint32_t>(&bytes[6]);
  d.gain = loadLas<double>(&bytes[10]);
  d.offset = loadLas<double>(&bytes[18]);
  const std::string fault = faultOf(d, std::to_integer<unsigned>(bytes[1]));
  if (!fault.empty()) throw InputError(name + " describes " + fault);
  return d;
}

/// Whether a descriptor has no samples: some writers fill a table of descriptors with such.
bool isUnused(const std::vector<std::byte>& bytes) {
  return bytes.size() >= kDescriptorBytes && loadLas<std::uint32_t>(&bytes[2]) == 0;
}

bool equal(const WaveformDescriptor& a, const WaveformDescriptor& b) {
  return a.bits == b.bits && a.samples == b.samples && a.spacing_ps == b.spacing_ps &&
         a.gain == b.gain && a.offset == b.offset;
}

}  // namespace

std::string WaveformDescriptor::describe() const {
  return grouped(samples) + (samples == 1 ? " sample of " : " samples of ") + std::to_string(bits) +
         " bits, " + std::to_string(spacing_ps) + " ps apart";
}

std::map<unsigned, WaveformDescriptor> readWaveformDescriptors(const LasFile& las) {
  std::map<unsigned, WaveformDescriptor> descriptors;
  for (const LasVlrEntry& vlr : las.vlrs()) {
    if (!isDescriptor(vlr)) continue;
    const std::string name = las.path().string() + ": waveform packet descriptor (record " +
                             std::to_string(vlr.record_id) + ")";
    const std::vector<std::byte> payload = las.payload(vlr);
    if (isUnused(payload)) continue;
    const WaveformDescriptor found = parseDescriptor(payload, name);
    const auto [at, is_new] = descriptors.emplace(vlr.record_id - kRecordOfIndexZero, found);
    if (!is_new && !equal(at->second, found))
      throw InputError(name + " occurs twice, with different values");
  }
  return descriptors;
}

WaveformReference WaveformReference::of(const std::byte* record, const LasRecordLayout& layout) {
  const std::byte* at = record + layout.waveform;
  WaveformReference reference;
  reference.descriptor = std::to_integer<unsigned>(at[0]);
  reference.byte_offset = loadLas<std::uint64_t>(at + 1);
  reference.bytes = loadLas<std::uint32_t>(at + 9);
  reference.location_ps = loadLas<float>(at + 13);
  for (int axis = 0; axis < 3; ++axis)
    reference.direction[axis] = loadLas<float>(at + 17 + 4 * axis);
  return reference;
}

void WaveformReference::store(std::byte* record, const LasRecordLayout& layout) const {
  std::byte* at = record + layout.waveform;
  at[0] = static_cast<std::byte>(descriptor);
  storeLas(at + 1, byte_offset);
  storeLas(at + 9, bytes);
  storeLas(at + 13, location_ps);
  for (int axis = 0; axis < 3; ++axis) storeLas(at + 17 + 4 * axis, direction[axis]);
}

}  // namespace pcl_als
