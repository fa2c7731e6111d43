// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/waveform/pulse_waves_reader.h>

namespace pcl_als {
namespace {

std::string samplingText(const PulseSampling& s) {
  const bool outgoing = s.type == PulseSampling::Type::outgoing;
  std::string text = outgoing ? "outgoing" : "returning";
  if (s.type == PulseSampling::Type::undefined) text = "of undefined type";
  if (s.channel > 0) text += ", channel " + std::to_string(s.channel);
  text += ": " + (s.segment_bits > 0 ? std::string("segments") : counted(s.segments, "segment"));
  text += " of " + (s.sample_bits > 0 ? std::string("samples") : counted(s.samples, "sample"));
  text += " of " + counted(s.bits, "bit") + ", " + shortText(s.spacing_ns) + " ns apart";
  if (s.table > 0) text += ", lookup table " + std::to_string(s.table);
  return text;
}

std::string scannerText(unsigned index, const PulseScanner& s) {
  std::string text = "scanner " + std::to_string(index) + ": " +
                     (s.instrument.empty() ? "not named" : s.instrument);
  if (!s.serial.empty()) text += ", serial number " + s.serial;
  const auto add = [&text](const char* what, float value, const char* unit) {
    if (value > 0.0F) text += std::string(", ") + what + " " + significantText(value, 4) + unit;
  };
  add("wavelength", s.wavelength_nm, " nm");
  add("pulse", s.pulse_width_ns, " ns");
  add("pulse rate", s.pulse_frequency_khz, " kHz");
  add("divergence", s.divergence_mrad, " mrad");
  return text;
}

/// InputError if the Waves file cannot be read.
/// A file without its waves can still be described.
std::string wavesText(const PulseWavesFile& file) {
  try {
    const WavesFile waves(file);
    return "waveforms in " + std::filesystem::path(waves.name()).filename().string() + ", " +
           grouped(waves.size()) + " bytes";
  } catch (const InputError& error) {
    return std::string("! ") + error.what();
  }
}

}  // namespace

std::vector<std::string> describePulseWaves(const PulseWavesFile& file) {
  const PulseWavesHeader& h = file.header();
  std::vector<std::string> texts;
  texts.push_back("PulseWaves " + std::to_string(h.version_major) + "." +
                  std::to_string(h.version_minor) + ", " + grouped(h.pulse_count) + " pulses" +
                  (h.generating_software.empty() ? "" : ", written by " + h.generating_software));
  std::string box = "sampled parts by the header:";
  const char* const axes[] = {" x ", ", y ", ", z "};
  for (int axis = 0; axis < 3; ++axis)
    box += axes[axis] + shortText(h.minimum[axis]) + " to " + shortText(h.maximum[axis]);
  texts.push_back(box);
  if (h.pulse_count > 0) {
    std::vector<PulseRecord> first, last;
    file.read(0, 1, first);
    file.read(h.pulse_count - 1, 1, last);
    texts.push_back("GPS time " + numberText(file.timeOf(first[0]), 6) + " (first pulse) to " +
                    numberText(file.timeOf(last[0]), 6) + " s (last pulse), " +
                    (file.hasStandardTime() ? "adjusted standard time" : "seconds of the week"));
  }
  for (const auto& [index, scanner] : file.scanners()) texts.push_back(scannerText(index, scanner));
  for (const auto& [index, descriptor] : file.descriptors())
    for (const PulseSampling& sampling : descriptor.samplings)
      texts.push_back("pulse descriptor " + std::to_string(index) + ", " + samplingText(sampling));
  for (const auto& [index, tables] : file.tables())
    for (const SampleTable& table : tables)
      texts.push_back("lookup table " + std::to_string(index) + ": " +
                      counted(table.entries.size(), "value") +
                      (table.description.empty() ? "" : ", " + table.description));
  texts.push_back(wavesText(file));
  return texts;
}

}  // namespace pcl_als
