// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <functional>
#include <mutex>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/header_box.h>
#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/pcd_writer.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/point_conversion.h>
#include <pcl_als/survey/survey_reader.h>

#include "conversion_paths.h"
#include "point_sink.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using detail::PointSink;

/// Outputs that are written in one reading of the inputs: each holds a few MB and an open file.
constexpr std::size_t kMostOutputs = 16;

/// The points of a file and, of LAS, their records.
class Source {
 public:
  Source(const fs::path& path, const PointWindow& window) {
    constexpr auto refuse = PointReader::OtherCoordinates::refuse;
    if (detail::isLas(path)) {
      auto las = std::make_unique<LasPointReader>(path, window, refuse, kLazAllFields);
      las_ = las.get();
      reader_ = std::move(las);
    } else {
      reader_ = PointReader::open(path, window);
    }
  }

  const PointFileInfo& info() const { return reader_->info(); }
  bool read() {
    const bool more = reader_->read(chunk_);
    box_.extend(boxOf(chunk_, 0, chunk_.size()));
    return more;
  }
  /// That the header is wrong, after the last points were read.
  std::string boxRemark() const {
    const std::string remark = reader_->boxRemark(box_);
    return remark.empty() ? remark : info().path.string() + ": " + remark;
  }
  const PointChunk& chunk() const { return chunk_; }
  /// Sets the point source id of the rows [from, to), in the columns and in the records.
  void setNumber(std::size_t from, std::size_t to, std::uint16_t number) {
    std::fill(chunk_.point_source_id.begin() + static_cast<std::ptrdiff_t>(from),
              chunk_.point_source_id.begin() + static_cast<std::ptrdiff_t>(to), number);
    if (las_ == nullptr) return;
    const LasFile& file = las_->file();
    for (std::size_t row = from; row < to; ++row)
      file.layout().storeSource(number, las_->records() + row * file.header().record_length);
  }
  detail::PointBlock block() {
    if (las_ == nullptr) return {chunk_};
    return {chunk_, &las_->file(), las_->records()};
  }
  std::string damage() const { return reader_->damage(); }
  /// What is not used of the file, with its name.
  std::vector<std::string> remarks() const {
    std::vector<std::string> remarks = reader_->remarks();
    for (std::string& text : remarks) text.insert(0, info().path.string() + ": ");
    return remarks;
  }
  /// What the points lose in a file of that name; empty: nothing.
  std::string lossIn(const fs::path& output) const {
    if (las_ == nullptr || detail::isLas(output)) return {};
    return detail::fieldsWithoutColumn(las_->file(), output);
  }

 private:
  std::unique_ptr<PointReader> reader_;
  LasPointReader* las_ = nullptr;
  PointChunk chunk_;
  Eigen::AlignedBox3d box_;  ///< of the points that were read
};

constexpr double kOriginStep = 10.0;  ///< metres: origins of PCD are multiples of it

/// Ends the writing of a PCD whose origin was taken from a header that the points contradict.
struct BoxIsWrong {};

/// A run of points that go to one output.
struct Run {
  std::size_t to = 0;                   ///< row behind the last one
  int target = -1;                      ///< -1: to none
  std::optional<std::uint16_t> number;  ///< point source id in the output; empty: as it is
};

/// The run of a chunk of a file that begins with a row.
using Distribution = std::function<Run(std::size_t file, const PointChunk&, std::size_t from)>;

class Conversion {
 public:
  Conversion(const std::vector<fs::path>& inputs, const PointConversionOptions& options,
             const ProgressCallback& progress)
      : inputs_(inputs), options_(options), report_(progress) {
    requirePointFiles(inputs.size());
    const StripChoice& choice = options.strips;
    const bool chosen = !choice.only.empty() || !choice.without.empty();
    if (options.number_lines && (chosen || choice.split))
      throw UsageError("numbers of lines are written to whole files: choose no strips");
    if (options.las_version &&
        (chosen || choice.split || options.number_lines || !options.window.everything()))
      throw UsageError(
          "the version of LAS is changed of whole files: convert them first, then "
          "choose parts");
    if (!chosen && !choice.split && !options.number_lines) return;
    StripChoice strips = choice;
    strips.split = choice.split || options.number_lines;
    strips.keep_timeless = !strips.split;  // nothing here needs times
    report_.begin("Reading " + counted(inputs.size(), "file"));
    arranged_.emplace(SurveyReader::ofFiles(inputs, options.threads, options.window));
    arranged_->choose(strips, {});
    label_counts_.resize(arranged_->arrangement().labels().size());
    const std::vector<std::string>& names = arranged_->strips();
    report_.end(counted(names.size(), "strip"));
    if (strips.split && !options.keep_ids) numbers_ = detail::lineNumbers(names);
    std::vector<std::string> changed;
    for (std::size_t i = 0; i < numbers_.size(); ++i)
      if (names[i] != std::to_string(numbers_[i]))
        changed.push_back(names[i] + " = " + std::to_string(numbers_[i]));
    if (!changed.empty()) remarkOnce("point source ids of lines: " + listedNames(changed, 100));
  }

  PointConversionResult run(const fs::path& output) {
    if (options_.strips.split)
      writeStrips(detail::stripPaths(inputs_, output, options_.format, arranged_->strips()));
    else
      writeFiles(detail::outputPaths(inputs_, output, options_.format));
    if (arranged_ && !options_.number_lines)
      result_.excluded = arranged_->arrangement().excludedPoints(label_counts_);
    if (result_.outputs.empty()) refuseNothing();
    return std::move(result_);
  }

 private:
  struct Target {
    fs::path path;
    std::string strip;
    Eigen::AlignedBox3d box;          ///< of its points; empty: that of the header is tried
    std::unique_ptr<PointSink> sink;  ///< opened with the first point
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of a PCD, about
    Eigen::AlignedBox3d seen{};  ///< of the points so far, where that of the header is tried
  };

  [[noreturn]] void refuseNothing() const {
    if (options_.window.everything()) throw InputError("no point is left, the files have none");
    refuseEmptyWindow(inputs_, options_.window);
  }

  bool copiesWholeFile(const fs::path& input, const fs::path& output) const {
    return options_.window.everything() && !arranged_ && detail::isLas(input) &&
           detail::isLas(output);
  }

  void writeFiles(const std::vector<fs::path>& outputs) {
    const Distribution chosen = options_.number_lines ? numberedPoints() : chosenPoints();
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (options_.las_version && !detail::isLas(outputs[i]))
        throw UsageError(outputs[i].string() + ": has no version of LAS");
      report_.begin("Writing " + outputs[i].string());
      const std::size_t before = result_.outputs.size();
      if (copiesWholeFile(inputs_[i], outputs[i])) {
        copyFile(inputs_[i], outputs[i]);
      } else {
        writeFile(i, outputs[i], chosen);
      }
      const bool written = result_.outputs.size() > before;
      report_.end(written ? grouped(result_.outputs.back().points) + " points"
                          : "not written, no point is left");
    }
  }

  /// The header tells the origin of a PCD, as long as the points do not contradict it: then they
  /// are read for their box first.
  void writeFile(std::size_t input, const fs::path& output, const Distribution& chosen) {
    records_ = detail::isLas(inputs_[input]);
    std::vector<Target> targets(1);
    targets[0].path = output;
    if (arranged_) targets[0].box = arranged_->files()[input].sources.box();
    try {
      distribute({input}, targets, chosen);
    } catch (const BoxIsWrong&) {
      targets[0] = {output, {}, boxInWindow(input), nullptr};
      distribute({input}, targets, chosen);
    }
    finish(targets);
  }

  Eigen::AlignedBox3d boxInWindow(std::size_t input) const {
    Eigen::AlignedBox3d box;
    Source source(inputs_[input], options_.window);
    while (source.read()) box.extend(boxOf(source.chunk(), 0, source.chunk().size()));
    return box;
  }

  void copyFile(const fs::path& input, const fs::path& output) {
    const LasFile file(input);
    if (options_.las_version) {
      const auto written = convertLasVersion(file, output, *options_.las_version, options_.threads);
      result_.outputs.push_back({output, written.points});
      for (const std::string& text : written.remarks) remarkOnce(input.string() + ": " + text);
      return;
    }
    const auto count = static_cast<double>(std::max<std::uint64_t>(1, file.header().point_count));
    LasExtension none;
    none.keeps_coordinates = true;
    std::mutex mutex;
    std::uint64_t done = 0;
    const LasEdit edit = [&](const LasRecordBlock& block) {
      const std::lock_guard<std::mutex> lock(mutex);
      done += block.count;
      report_.advance(static_cast<double>(done) / count);
    };
    const auto copied = extendLas(file, output, none, edit, options_.threads);
    result_.outputs.push_back({output, copied.points});
    for (const std::string& text : copied.remarks) remarkOnce(input.string() + ": " + text);
  }

  void writeStrips(const std::vector<fs::path>& paths) {
    std::vector<std::size_t> all(inputs_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const std::vector<std::string>& names = arranged_->strips();
    std::vector<Eigen::AlignedBox3d> boxes(names.size());
    records_ = std::all_of(inputs_.begin(), inputs_.end(), detail::isLas);
    if (!records_ || !detail::isLas(paths[0])) boxes = arranged_->measure().boxes;
    std::vector<PointFileInfo> infos;
    for (const SurveyedFile& file : arranged_->files()) infos.push_back(file.sources.info);
    for (const std::string& text : commonReference(infos).remarks) remarkOnce(text);
    for (std::size_t first = 0; first < names.size(); first += kMostOutputs) {
      const std::size_t last = std::min(names.size(), first + kMostOutputs);
      report_.begin("Writing " + counted(last - first, "strip"));
      std::vector<Target> targets;
      for (std::size_t i = first; i < last; ++i)
        targets.push_back({paths[i], names[i], boxes[i], nullptr});
      distribute(all, targets, stripPoints(first, last));
      const std::uint64_t points = finish(targets);
      report_.end(grouped(points) + " points");
    }
  }

  /// Everything in the window and of the chosen strips goes to one output.
  Distribution chosenPoints() {
    if (!arranged_)
      return [](std::size_t, const PointChunk& chunk, std::size_t) {
        return Run{chunk.size(), 0, std::nullopt};
      };
    const Distribution strips = stripPoints(0, arranged_->strips().size());
    return [strips](std::size_t file, const PointChunk& chunk, std::size_t from) {
      const Run run = strips(file, chunk, from);
      return Run{run.to, run.target < 0 ? -1 : 0, std::nullopt};
    };
  }

  /// Everything, with the numbers of lines.
  Distribution numberedPoints() {
    const Distribution strips = stripPoints(0, arranged_->strips().size());
    return [strips](std::size_t file, const PointChunk& chunk, std::size_t from) {
      const Run run = strips(file, chunk, from);
      return Run{run.to, 0, run.number.value_or(0)};
    };
  }

  /// Points of the strips [first, last), each to an output of its own.
  Distribution stripPoints(std::size_t first, std::size_t last) {
    std::fill(label_counts_.begin(), label_counts_.end(), 0);
    const auto low = static_cast<int>(first), high = static_cast<int>(last);
    return [this, low, high](std::size_t file, const PointChunk& chunk, std::size_t from) {
      const SurveyReader::Run found = arranged_->runAt(file, chunk, from);
      const int strip = found.strip;
      label_counts_[found.label] += found.to - from;
      Run run{found.to, strip >= low && strip < high ? strip - low : -1, std::nullopt};
      if (strip >= 0 && !numbers_.empty()) run.number = numbers_[static_cast<std::size_t>(strip)];
      return run;
    };
  }

  void distribute(const std::vector<std::size_t>& files, std::vector<Target>& targets,
                  const Distribution& target_of) {
    std::uint64_t done = 0;
    for (const std::size_t file : files) {
      Source source(inputs_[file], options_.window);
      if (!source.damage().empty()) remarkOnce(source.damage());
      for (const std::string& text : source.remarks()) remarkOnce(text);
      while (source.read()) {
        const PointChunk& chunk = source.chunk();
        Run run;
        for (std::size_t from = 0; from < chunk.size(); from = run.to) {
          run = target_of(file, chunk, from);
          if (run.target < 0) continue;
          if (run.number) source.setNumber(from, run.to, *run.number);
          append(targets[static_cast<std::size_t>(run.target)], file, source, from, run.to);
        }
        done += chunk.size();
        report_.advance(std::min(1.0, static_cast<double>(done) / expected(files, source)));
      }
      if (!source.boxRemark().empty()) remarkOnce(source.boxRemark());
    }
    for (const Target& target : targets) checkOrigin(target);
  }

  static bool triesHeader(const Target& target) {
    return target.box.isEmpty() && detail::isPcd(target.path);
  }

  /// The points of a PCD are relative to the middle of the box that it was opened with.
  static void checkOrigin(const Target& target) {
    if (!target.sink || !triesHeader(target)) return;
    const Eigen::AlignedBox2d seen(target.seen.min().head<2>().eval(),
                                   target.seen.max().head<2>().eval());
    if (seen.exteriorDistance(target.origin.head<2>().eval()) > kOriginStep) throw BoxIsWrong();
  }

  static bool isWithinReach(const Target& target) {
    const Eigen::Vector3d farthest =
        (target.seen.max() - target.origin).cwiseMax(target.origin - target.seen.min());
    return farthest.maxCoeff() < PcdWriter::kFarthest - kOriginStep;
  }

  /// Points of all files, as far as their number is known.
  static double expected(const std::vector<std::size_t>& files, const Source& source) {
    return static_cast<double>(files.size() *
                               std::max<std::uint64_t>(1, source.info().point_count));
  }

  void append(Target& target, std::size_t file, Source& source, std::size_t from, std::size_t to) {
    if (!target.sink) {
      PointFileInfo info = source.info();
      if (!target.box.isEmpty()) info.minimum = target.box.min(), info.maximum = target.box.max();
      target.sink =
          detail::openSink(target.path, inputs_[file], info,
                           {records_, options_.window.keep_readable, target.strip, options_.threads,
                            options_.las_version.value_or(LasVersion()), options_.ascii_ply});
      target.origin = 0.5 * (info.minimum + info.maximum);
      const std::string loss = source.lossIn(target.path);
      if (!loss.empty()) remarkOnce(loss);
    }
    if (triesHeader(target)) {
      target.seen.extend(boxOf(source.chunk(), from, to));
      if (!headerBoxContains(source.info(), target.seen) || !isWithinReach(target))
        throw BoxIsWrong();
    }
    target.sink->append(source.block(), from, to);
  }

  void remarkOnce(const std::string& text) {
    const auto& known = result_.remarks;
    if (std::find(known.begin(), known.end(), text) == known.end()) result_.remarks.push_back(text);
  }

  std::uint64_t finish(std::vector<Target>& targets) {
    std::uint64_t points = 0;
    for (Target& target : targets) {
      if (!target.sink) continue;
      target.sink->finish();
      for (const std::string& text : target.sink->remarks()) remarkOnce(text);
      result_.outputs.push_back({target.path, target.sink->pointCount()});
      points += target.sink->pointCount();
    }
    return points;
  }

  const std::vector<fs::path>& inputs_;
  const PointConversionOptions& options_;
  ProgressReport report_;
  std::optional<SurveyReader> arranged_;
  std::vector<std::uint64_t> label_counts_;
  std::vector<std::uint16_t> numbers_;  ///< by strip: point source id; empty: points keep theirs
  bool records_ = false;                ///< all points of the targets have raw records
  PointConversionResult result_;
};

}  // namespace

PointConversionResult convertPointFiles(const std::vector<fs::path>& inputs, const fs::path& output,
                                        const PointConversionOptions& options,
                                        const ProgressCallback& progress) {
  const UnchangedInputs unchanged;
  FileProtection protection(inputs);
  if (isConversionFolder(output, options.strips.split || inputs.size() != 1))
    protection.guard(output);
  return Conversion(inputs, options, progress).run(output);
}

}  // namespace pcl_als
