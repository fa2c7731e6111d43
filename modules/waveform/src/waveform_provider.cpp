// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/waveform/waveform_provider.h>

namespace pcl_als {
namespace {

constexpr std::size_t kRecordsTogether = std::size_t{1} << 16;
constexpr unsigned kLargestDescriptor = 255;

/// References of all points, with directions in metres.
std::vector<WaveformReference> referencesOf(const LasFile& las) {
  const std::uint64_t all = las.header().point_count;
  const std::size_t length = las.header().record_length;
  const Eigen::Vector3f metres_per_unit =
      las.toMetres().scale.cwiseQuotient(las.header().scale).cast<float>();
  std::vector<WaveformReference> references;
  references.reserve(all);
  std::vector<std::byte> records;
  for (std::uint64_t first = 0; first < all; first += kRecordsTogether) {
    const std::size_t count = std::min<std::uint64_t>(kRecordsTogether, all - first);
    records.resize(count * length);
    las.readRecords(first, count, records.data());
    for (std::size_t i = 0; i < count; ++i) {
      references.push_back(WaveformReference::of(&records[i * length], las.layout()));
      references.back().direction = references.back().direction.cwiseProduct(metres_per_unit);
    }
  }
  return references;
}

class LasAccess : public WaveformProvider::Access {
 public:
  LasAccess(const WaveformSource& source, const std::vector<WaveformReference>& references)
      : reader_(source), references_(references) {}
  bool read(std::size_t point, Waveform& waveform) override {
    return reader_.read(references_[point], point, waveform);
  }

 private:
  WaveformReader reader_;
  const std::vector<WaveformReference>& references_;
};

}  // namespace

struct LasWaveforms::State {
  explicit State(const std::filesystem::path& path)
      : las(path), source(las), references(referencesOf(las)) {}

  LasFile las;
  WaveformSource source;
  std::vector<WaveformReference> references;
};

LasWaveforms::LasWaveforms(const std::filesystem::path& path)
    : state_(std::make_unique<State>(path)) {}
LasWaveforms::~LasWaveforms() = default;

const LasFile& LasWaveforms::las() const {
  return state_->las;
}
std::size_t LasWaveforms::size() const {
  return state_->references.size();
}
std::string LasWaveforms::name() const {
  return state_->las.path().string();
}
const std::map<unsigned, WaveformDescriptor>& LasWaveforms::descriptors() const {
  return state_->source.descriptors();
}
const WaveformReference& LasWaveforms::reference(std::size_t point) const {
  return state_->references[point];
}
std::unique_ptr<WaveformProvider::Access> LasWaveforms::access() const {
  return std::make_unique<LasAccess>(state_->source, state_->references);
}

class MemoryWaveforms::MemoryAccess : public WaveformProvider::Access {
 public:
  explicit MemoryAccess(const MemoryWaveforms& all) : all_(all) {}
  bool read(std::size_t point, Waveform& waveform) override {
    const WaveformReference& reference = all_.references_[point];
    if (reference.descriptor == 0) return false;
    waveform.reference = reference;
    waveform.descriptor = all_.descriptors_.at(reference.descriptor);
    waveform.counts = all_.waveforms_[reference.byte_offset].counts;
    return true;
  }

 private:
  const MemoryWaveforms& all_;
};

void MemoryWaveforms::setDescriptor(unsigned index, const WaveformDescriptor& descriptor) {
  if (index == 0 || index > kLargestDescriptor)
    throw UsageError("the index of a waveform descriptor must be from 1 to 255");
  if (descriptor.samples == 0 || descriptor.spacing_ps == 0)
    throw UsageError("a waveform descriptor needs samples and a time between them");
  descriptors_[index] = descriptor;
}

std::uint64_t MemoryWaveforms::addWaveform(unsigned descriptor, std::vector<double> counts) {
  const auto found = descriptors_.find(descriptor);
  if (found == descriptors_.end())
    throw UsageError("there is no waveform descriptor " + std::to_string(descriptor));
  if (counts.size() != found->second.samples)
    throw UsageError("a waveform has " + std::to_string(counts.size()) +
                     " samples, its descriptor " + std::to_string(found->second.samples));
  waveforms_.push_back({descriptor, std::move(counts)});
  return waveforms_.size() - 1;
}

void MemoryWaveforms::assign(std::size_t point, std::uint64_t waveform, float location_ps,
                             const Eigen::Vector3f& direction) {
  if (point >= references_.size())
    throw UsageError("there is no point " + std::to_string(point) + " among " +
                     std::to_string(references_.size()));
  if (waveform >= waveforms_.size())
    throw UsageError("there is no waveform " + std::to_string(waveform));
  WaveformReference& reference = references_[point];
  reference.descriptor = waveforms_[waveform].descriptor;
  reference.byte_offset = waveform;
  reference.location_ps = location_ps;
  reference.direction = direction;
}

std::unique_ptr<WaveformProvider::Access> MemoryWaveforms::access() const {
  return std::make_unique<MemoryAccess>(*this);
}

}  // namespace pcl_als
