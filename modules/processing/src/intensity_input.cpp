// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/intensity_input.h>

#include "intensity_pcd.h"
#include "intensity_survey.h"
#include "surface_points.h"

namespace pcl_als {
namespace {

constexpr std::size_t kBlock = 4096;  ///< records that share a box

/// Box of the points of one strip in a block, in coordinate steps of the file.
struct BlockBox {
  std::uint32_t block = 0;
  std::uint16_t source = 0;
  std::int32_t min_x = 0, min_y = 0, max_x = 0, max_y = 0;

  void add(const BlockBox& other) {
    min_x = std::min(min_x, other.min_x);
    min_y = std::min(min_y, other.min_y);
    max_x = std::max(max_x, other.max_x);
    max_y = std::max(max_y, other.max_y);
  }
  bool near(const BlockBox& other, double margin_x, double margin_y) const {
    return source == other.source && min_x <= other.max_x + margin_x &&
           max_x >= other.min_x - margin_x && min_y <= other.max_y + margin_y &&
           max_y >= other.min_y - margin_y;
  }
};

class LasInput : public IntensityInput {
 public:
  LasInput(const std::string& path, const Options& options)
      : IntensityInput(path),
        file_(path),
        layout_(file_.layout()),
        length_(file_.header().record_length),
        scale_(file_.toMetres().scale),
        offset_(file_.toMetres().offset) {
    window_ = options.window;
    survey_.sources.info = file_.info();
    survey_.has_time = layout_.gps_time >= 0;
    findGainControl(options.gain_control);
    if (options.echo_energy)
      amplitude_ = echoField("amplitude"), echo_width_ = echoField("echo_width");
    look(file_.header().compressed ? 1 : options.threads);
  }

  std::size_t windows() const override {
    return (file_.header().point_count + window_ - 1) / window_;
  }
  const LasFile* las() const override { return &file_; }

  void load(std::size_t window, const WindowRequest& request, IntensityWindow& out) const override {
    const std::uint64_t first = window * std::uint64_t{window_};
    const std::size_t count = std::min<std::uint64_t>(window_, file_.header().point_count - first);
    thread_local std::vector<std::byte> own;
    const std::byte* records = request.records;
    if (records == nullptr) read(first, count, own), records = own.data();
    const std::size_t step = request.records == nullptr ? length_ : request.record_length;
    out.origin = positionOf(records);
    out.points.resize(count);
    StripAssignment::Assigner sorter(*request.arrangement, request.file);
    for (std::size_t i = 0; i < count; ++i) {
      out.points[i] = pointOf(records + i * step);
      out.points[i].label = labelOf(sorter, out.points[i]);
    }
    out.gain_control.clear();
    if (gain_control_ != nullptr)
      decodeLasExtraField(records, count, step, *gain_control_, out.gain_control);
    out.surface_points.clear();
    if (!request.surfaces) return;
    SurfacePoints surface_points(*request.arrangement, out);
    for (const IntensityPoint& point : out.points) surface_points.add(point);
    loadNeighbours(window, request, sorter, out);
  }

 private:
  void read(std::uint64_t first, std::size_t count, std::vector<std::byte>& records) const {
    records.resize(count * length_);
    file_.readRecords(first, count, records.data());
  }

  void findGainControl(const std::string& name) {
    if (name.empty()) return;
    gain_control_ = findLasExtraField(file_.extraFields(), name, path_);
    if (gain_control_ != nullptr && gain_control_->type != LasExtraType::undocumented) return;
    std::string names;
    for (const LasExtraField& field : file_.extraFields()) names += " " + field.name;
    throw InputError(path_ + ": has no extra field " + name + " of gain control values" +
                     (names.empty() ? "; it has none at all" : "; it has" + names));
  }

  /// Position of a field of echoes in the records.
  std::ptrdiff_t echoField(const char* name) const {
    const LasExtraField* field = findLasExtraField(file_.extraFields(), name, path_);
    if (field == nullptr || field->type != LasExtraType::f32)
      throw InputError(path_ + ": has no extra field " + name +
                       " of echoes; decompose its waveforms first");
    return static_cast<std::ptrdiff_t>(field->position);
  }

  /// Intensity, or the energy of the echo; 0 without one.
  float intensityOf(const std::byte* record) const {
    if (amplitude_ < 0) return LasRecordLayout::intensityOf(record);
    const float energy = loadLas<float>(record + amplitude_) * loadLas<float>(record + echo_width_);
    return energy > 0.0F ? energy : 0.0F;
  }

  Eigen::Vector3d positionOf(const std::byte* record) const {
    return LasRecordLayout::positionOf(record, scale_, offset_);
  }
  Eigen::Vector3d metres(const std::array<std::int32_t, 3>& raw) const {
    return Eigen::Vector3d(raw[0], raw[1], raw[2]).cwiseProduct(scale_) + offset_;
  }

  IntensityPoint pointOf(const std::byte* record) const {
    IntensityPoint point;
    point.position = positionOf(record);
    point.time = layout_.timeOf(record);
    point.intensity = intensityOf(record);
    point.source = layout_.sourceOf(record);
    point.return_number = static_cast<std::uint8_t>(layout_.returnNumberOf(record));
    point.number_of_returns = static_cast<std::uint8_t>(layout_.numberOfReturnsOf(record));
    point.classification = layout_.classOf(record);
    return point;
  }

  /// First pass: survey and boxes, window by window.
  void look(int threads) {
    std::vector<SurveyStatistics> counters(windows());
    std::vector<std::vector<BlockBox>> boxes(windows());
    parallelFor(windows(), threads, [&](std::size_t window) {
      thread_local std::vector<std::byte> records;
      const std::uint64_t first = window * std::uint64_t{window_};
      const std::size_t count =
          std::min<std::uint64_t>(window_, file_.header().point_count - first);
      read(first, count, records);
      for (std::size_t at = 0; at < count; at += kBlock)
        lookAtBlock(static_cast<std::uint32_t>((first + at) / kBlock), &records[at * length_],
                    std::min(kBlock, count - at), counters[window], boxes[window]);
    });
    SurveyStatistics sum;
    for (const SurveyStatistics& counters : counters) sum.merge(counters);
    sum.store(survey_);
    const Eigen::AlignedBox3d box = survey_.sources.box();
    if (!box.isEmpty())
      survey_.sources.info.minimum = box.min(), survey_.sources.info.maximum = box.max();
    for (const std::vector<BlockBox>& part : boxes) {
      first_box_.push_back(boxes_.size());
      boxes_.insert(boxes_.end(), part.begin(), part.end());
    }
    first_box_.push_back(boxes_.size());
  }

  void lookAtBlock(std::uint32_t block, const std::byte* records, std::size_t count,
                   SurveyStatistics& counters, std::vector<BlockBox>& boxes) const {
    const std::size_t first_of_block = boxes.size();
    for (std::size_t at = 0; at < count;) {
      BlockBox box;
      PointRun run;
      const std::byte* const first = records + at * length_;
      at += lookAtRun(first, count - at, box, run);
      counters.add(run);
      if (survey_.has_time) addPlaces(first, run, counters);
      box.block = block;
      const auto same =
          std::find_if(boxes.begin() + static_cast<std::ptrdiff_t>(first_of_block), boxes.end(),
                       [&run](const BlockBox& b) { return b.source == run.source; });
      if (same == boxes.end())
        boxes.push_back(box);
      else
        same->add(box);
    }
  }

  /// The track of a strip needs few of its points.
  void addPlaces(const std::byte* records, const PointRun& run, SurveyStatistics& counters) const {
    constexpr std::size_t kEvery = 32;
    thread_local PointChunk places;
    for (auto* column : {&places.x, &places.y, &places.gps_time}) column->clear();
    for (std::size_t i = 0; i < run.points; i += kEvery) {
      const std::byte* const record = records + i * length_;
      const Eigen::Vector3d place = positionOf(record);
      places.x.push_back(place.x());
      places.y.push_back(place.y());
      places.gps_time.push_back(layout_.timeOf(record));
    }
    counters.addPlaces(run.source, places);
  }

  /// Looks at the records of the first one's strip; returns how many there are in a row.
  std::size_t lookAtRun(const std::byte* records, std::size_t count, BlockBox& box,
                        PointRun& run) const {
    const std::uint16_t source = layout_.sourceOf(records);
    const std::byte* const first = records;
    auto least = LasRecordLayout::lanesOf(records), most = least;
    // In locals: a compiler must expect that bytes of records are those of the result.
    std::uint16_t largest = 0;
    std::uint64_t zeros = 0, zero_times = 0;
    TimeRange times;
    std::size_t i = 0;
    for (; i < count && layout_.sourceOf(records) == source; ++i, records += length_) {
      const auto value = LasRecordLayout::lanesOf(records);
      least = value < least ? value : least;
      most = value > most ? value : most;
      const std::uint16_t intensity = LasRecordLayout::intensityOf(records);
      largest = std::max(largest, intensity);
      zeros += intensity == 0 ? 1 : 0;
      const double time = layout_.timeOf(records);
      if (time == 0.0)
        ++zero_times;
      else
        times.add(time);
    }
    run.source = source;
    run.points = i;
    run.zeros = zeros;
    run.zero_time = zero_times > 0;
    run.times = times;
    run.largest = largest;
    if (amplitude_ >= 0) lookAtEnergies(first, run);
    run.minimum = metres({least[0], least[1], least[2]});
    run.maximum = metres({most[0], most[1], most[2]});
    box = {0, source, least[0], least[1], most[0], most[1]};
    return i;
  }

  void lookAtEnergies(const std::byte* records, PointRun& run) const {
    run.zeros = 0;
    run.largest = 0.0;
    for (std::uint64_t i = 0; i < run.points; ++i) {
      const float energy = intensityOf(records + i * length_);
      run.zeros += energy == 0.0F ? 1 : 0;
      run.largest = std::max(run.largest, static_cast<double>(energy));
    }
  }

  /// Blocks outside the window with points within the margin of a block of the same strip in it.
  std::set<std::uint32_t> blocksAround(std::size_t window,
                                       const std::map<std::uint16_t, double>& margins) const {
    std::set<std::uint32_t> blocks;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (i >= first_box_[window] && i < first_box_[window + 1]) continue;
      const auto margin = margins.find(boxes_[i].source);
      if (margin == margins.end()) continue;
      const double x = margin->second / std::abs(scale_.x());
      const double y = margin->second / std::abs(scale_.y());
      for (std::size_t own = first_box_[window]; own < first_box_[window + 1]; ++own) {
        if (!boxes_[i].near(boxes_[own], x, y)) continue;
        blocks.insert(boxes_[i].block);
        break;
      }
    }
    if (blocks.size() * kBlock > kMostNeighbours)
      throw InputError(path_ + ": its points are in no order of time or place (around " +
                       std::to_string(window_) + " of them lie more than " +
                       std::to_string(kMostNeighbours) + " others); sort it by time");
    return blocks;
  }

  void loadNeighbours(std::size_t window, const WindowRequest& request,
                      StripAssignment::Assigner& sorter, IntensityWindow& out) const {
    const std::map<std::uint16_t, double>& margins = request.margins;
    if (margins.empty()) return;
    std::map<std::uint16_t, Eigen::AlignedBox2f> reach;
    for (const IntensityPoint& point : out.points)
      reach[point.source].extend(Eigen::Vector2f(out.relative(point.position).head<2>()));
    for (auto& [source, box] : reach) {
      const auto margin = margins.find(source);
      const auto metres = static_cast<float>(margin == margins.end() ? 0.0 : margin->second);
      box.min().array() -= metres;
      box.max().array() += metres;
    }
    std::vector<std::byte> records;
    SurfacePoints surface_points(*request.arrangement, out);
    for (const std::uint32_t block : blocksAround(window, margins)) {
      const std::uint64_t first = block * std::uint64_t{kBlock};
      const std::size_t count = std::min<std::uint64_t>(kBlock, file_.header().point_count - first);
      read(first, count, records);
      for (std::size_t i = 0; i < count; ++i) {
        const auto box = reach.find(layout_.sourceOf(&records[i * length_]));
        if (box == reach.end()) continue;
        IntensityPoint point = pointOf(&records[i * length_]);
        if (!box->second.contains(Eigen::Vector2f(out.relative(point.position).head<2>())))
          continue;
        point.label = labelOf(sorter, point);
        surface_points.add(point);
      }
    }
  }

  LasFile file_;
  const LasRecordLayout layout_;  ///< of the file, as are the next three
  const std::size_t length_;
  const Eigen::Vector3d scale_, offset_;
  const LasExtraField* gain_control_ = nullptr;      ///< of file_
  std::ptrdiff_t amplitude_ = -1, echo_width_ = -1;  ///< in a record; -1: not used
  std::vector<BlockBox> boxes_;
  std::vector<std::size_t> first_box_;  ///< of each window, and the end
};

}  // namespace

std::unique_ptr<IntensityInput> IntensityInput::open(const std::string& path,
                                                     const Options& options) {
  requireCopyable(path);
  const std::string extension = lowerExtension(path);
  if (extension == ".pcd" && options.echo_energy)
    throw InputError(path + ": energies of echoes are read from LAS and LAZ files only");
  if (extension == ".pcd") return openIntensityPcd(path, options);
  if (extension == ".las" || extension == ".laz") return std::make_unique<LasInput>(path, options);
  throw InputError(path + ": is no point file by its name (.las, .laz or .pcd)");
}

}  // namespace pcl_als
