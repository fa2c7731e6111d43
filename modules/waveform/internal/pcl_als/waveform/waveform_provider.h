// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/waveform/waveform_reader.h>

namespace pcl_als {

class LasFile;

/** \brief The waveforms of the points of a cloud: point i of the cloud is point i of the provider.
 *
 * Directions of references are in metres per picosecond. Const member functions may be called by
 * several threads.
 */
class WaveformProvider {
 public:
  /// Reads waveforms of the provider; each thread needs one.
  class Access {
   public:
    virtual ~Access() = default;
    /// \return false if the point has no waveform. InputError as WaveformReader::read().
    virtual bool read(std::size_t point, Waveform& waveform) = 0;
  };

  virtual ~WaveformProvider() = default;
  /// Number of points.
  virtual std::size_t size() const = 0;
  /// Name for messages: the file, or "waveforms".
  virtual std::string name() const = 0;
  virtual const std::map<unsigned, WaveformDescriptor>& descriptors() const = 0;
  virtual const WaveformReference& reference(std::size_t point) const = 0;
  virtual std::unique_ptr<Access> access() const = 0;
};

/// The waveforms of a LAS or LAZ file, for a cloud of all its points in their order. Memory: 40
/// bytes for each point; waveforms are read from the file when they are needed.
class LasWaveforms : public WaveformProvider {
 public:
  /// InputError as LasFile and WaveformSource.
  explicit LasWaveforms(const std::filesystem::path& path);
  ~LasWaveforms() override;

  const LasFile& las() const;
  std::size_t size() const override;
  std::string name() const override;
  const std::map<unsigned, WaveformDescriptor>& descriptors() const override;
  const WaveformReference& reference(std::size_t point) const override;
  std::unique_ptr<Access> access() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/** \brief Waveforms in memory.
 * \code
 * auto waveforms = std::make_shared<pcl_als::MemoryWaveforms>(cloud->size());
 * waveforms->setDescriptor(1, descriptor);
 * const std::uint64_t pulse = waveforms->addWaveform(1, counts);
 * waveforms->assign(0, pulse, 30000.0F, {0, 0, 1.5e-4F});  // both returns of the pulse
 * waveforms->assign(1, pulse, 42000.0F, {0, 0, 1.5e-4F});
 * \endcode
 */
class MemoryWaveforms : public WaveformProvider {
 public:
  explicit MemoryWaveforms(std::size_t points) : references_(points) {}

  /// \param index 1 … 255. UsageError for another index, no samples and no spacing.
  void setDescriptor(unsigned index, const WaveformDescriptor& descriptor);
  /// \param counts digitizer counts, as many as the descriptor states (UsageError otherwise)
  /// \return number of the waveform
  std::uint64_t addWaveform(unsigned descriptor, std::vector<double> counts);
  /// \param location_ps of the point, from the first sample
  /// \param direction from the point towards the anchor, metres per picosecond
  /// UsageError for a point or a waveform that does not exist.
  void assign(std::size_t point, std::uint64_t waveform, float location_ps,
              const Eigen::Vector3f& direction);

  std::size_t size() const override { return references_.size(); }
  std::string name() const override { return "waveforms"; }
  const std::map<unsigned, WaveformDescriptor>& descriptors() const override {
    return descriptors_;
  }
  const WaveformReference& reference(std::size_t point) const override {
    return references_[point];
  }
  std::unique_ptr<Access> access() const override;

 private:
  class MemoryAccess;
  struct Stored {
    unsigned descriptor;
    std::vector<double> counts;
  };
  std::map<unsigned, WaveformDescriptor> descriptors_;
  std::vector<Stored> waveforms_;
  std::vector<WaveformReference> references_;
};

}  // namespace pcl_als
