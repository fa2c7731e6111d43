// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <pcl/filters/filter.h>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/waveform/pulse_echoes.h>
#include <pcl_als/waveform/waveform_provider.h>

namespace pcl_als {

/** \brief Decomposes the waveforms of a cloud into echoes and adds points for the echoes that the
 * scanner did not record as returns.
 *
 * The decomposition and the pairs of returns and echoes (PulseEchoes) are those of
 * decomposeWaveforms(), which writes files; the method is described on the page of module waveform.
 * Points of one pulse must follow each other, as in files of scanners. New points follow the points
 * of their pulse. They are copies of the nearest return at the position of the echo, with class 1,
 * the flag kSynthetic, and an intensity in proportion to the amplitude. Returns are numbered by
 * their times if points were added and all returns of the pulse are in the cloud.
 *
 * Fields needed: x, y, z in metres. In new points return_number with number_of_returns, intensity,
 * classification and flags are set if the type has them. For other types than PointLidar include
 * impl/waveform_decomposition.hpp. Points outside given indices are not moved and get no
 * attributes. The output is not organised. The input is not changed.
 * \code
 * pcl_als::WaveformDecomposition<pcl_als::PointLidar> decomposition;
 * decomposition.setWaveforms(std::make_shared<pcl_als::LasWaveforms>("strip1.las"));
 * decomposition.setInputCloud(strip.cloud);  // all points of strip1.las
 * decomposition.filter(echoes);
 * const float width = decomposition.getEchoes()[0].echo_width;  // of echoes[0], nanoseconds
 * \endcode
 */
template <typename PointT>
class WaveformDecomposition : public pcl::Filter<PointT> {
 public:
  using Ptr = std::shared_ptr<WaveformDecomposition<PointT>>;
  using ConstPtr = std::shared_ptr<const WaveformDecomposition<PointT>>;
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;
  using ProviderConstPtr = std::shared_ptr<const WaveformProvider>;

  WaveformDecomposition() { this->filter_name_ = "WaveformDecomposition"; }

  /// The waveforms of the points of the input cloud, in the order of the points; required.
  void setWaveforms(ProviderConstPtr waveforms) { waveforms_ = std::move(waveforms); }
  ProviderConstPtr getWaveforms() const { return waveforms_; }

  /// System response and criteria for echoes; UsageError (in filter()) for values out of range.
  void setSettings(const EchoSettings& settings) { settings_ = settings; }
  const EchoSettings& getSettings() const { return settings_; }

  /// Whether points are added for echoes without a return; default true.
  void setNewEchoes(bool add) { new_echoes_ = add; }
  bool getNewEchoes() const { return new_echoes_; }

  /// Whether returns are moved along their pulse to the positions of their echoes; default false.
  void setMoveReturns(bool move) { move_returns_ = move; }
  bool getMoveReturns() const { return move_returns_; }

  /// 0: all cores; the result does not depend on it. Default 0.
  void setNumberOfThreads(int threads) { threads_ = requiredThreads(threads); }
  int getNumberOfThreads() const { return threads_; }

  /// Attributes of each point of the last output (amplitude, width, standard deviations).
  const std::vector<EchoAttributes>& getEchoes() const { return echoes_; }
  /// For each point of the last output the index of the input point from which it was made.
  const pcl::Indices& getSourceIndices() const { return sources_; }
  /// Full width at half maximum of the response that was used, nanoseconds, by descriptor index.
  const std::map<unsigned, double>& getPulseWidths() const { return pulse_widths_; }

 protected:
  /// UsageError if waveforms are missing or are not one per point; InputError for damaged
  /// waveforms, and if the width of the response cannot be estimated.
  void applyFilter(PointCloud& output) override;

 private:
  struct Pulse {
    std::size_t first, count;
    bool repeated;  ///< its waveform was met before, with other points between
  };
  struct Part;

  std::map<unsigned, PulseResponse> findResponses();
  std::vector<Pulse> findPulses() const;
  void decompose(const Pulse& pulse, const std::vector<bool>& selected, Part& part) const;
  void addEchoes(const Pulse& pulse, Part& part) const;
  void numberReturns(const Pulse& pulse, std::size_t begin, Part& part) const;

  ProviderConstPtr waveforms_;
  EchoSettings settings_;
  bool new_echoes_ = true, move_returns_ = false;
  int threads_ = 0;
  std::vector<EchoAttributes> echoes_;
  pcl::Indices sources_;
  std::map<unsigned, double> pulse_widths_;
};

extern template class WaveformDecomposition<PointLidar>;

}  // namespace pcl_als
