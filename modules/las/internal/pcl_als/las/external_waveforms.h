// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <pcl_als/las/las_file.h>

namespace pcl_als {

/// Whether the records of a file refer to waveform packets, in the file or in another one.
bool refersToWaveforms(const LasFile& las);

/** \brief The waveform packets of a LAS file that are in a file beside it (LAS 1.4 R15, 2.7).
 *
 * That file has the name of the LAS file with the extension .wdp (.wdz where it is compressed).
 */
struct ExternalWaveforms {
  /// The records refer to packets that are not in the file: the global encoding says so, or there
  /// are packet descriptors and no record of packets.
  bool expected = false;
  std::filesystem::path file;  ///< empty: none is beside the LAS file
  std::uint64_t size = 0;      ///< bytes

  static ExternalWaveforms of(const LasFile& las);
  /// "waveforms in strip1.wdp, 12 345 bytes"; empty where none are expected.
  std::string describe() const;
};

/** \brief Copies the external waveforms of a LAS file to where a copy of the file refers to them.
 *
 * The records keep their offsets, so that the whole file is copied, whichever points the output
 * has. Nothing is copied where both names are one file or the same bytes.
 *
 * \code
 * WaveformCopy waveforms(input, "out.laz");  // refuses before the work begins
 * waveforms.prepare();                       // under a temporary name
 * waveforms.commit();                        // with the LAS file
 * \endcode
 */
class WaveformCopy {
 public:
  /// InputError where the name is taken by a file that an earlier version of \a output did not
  /// come with: one that belongs to another LAS file, or to none.
  WaveformCopy(const LasFile& input, const std::filesystem::path& output);
  ~WaveformCopy();
  WaveformCopy(WaveformCopy&&) noexcept;
  WaveformCopy& operator=(WaveformCopy&&) = delete;

  void prepare();
  void commit();
  /// What was copied, or is missing, for the user; empty where there are no external waveforms.
  std::string remark() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
