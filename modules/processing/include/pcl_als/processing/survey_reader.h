// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/survey/strip_arrangement.h>
#include <pcl_als/survey/survey_input.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief The points of a survey as strips, from files or clouds, which can be read repeatedly,
 * chunk by chunk.
 *
 * Strips are those of StripArrangement, divided by the channel of the scanner where
 * StripChoice::by_channel asks for it; points that it leaves out are counted and not passed on.
 * Files that share a strip are read one after the other in the given order, others in parallel: the
 * order of the points of a strip does not depend on the number of threads. A "file" is any
 * SurveyInput, such as a cloud from makeCloudInput().
 */
class SurveyReader {
 public:
  using Sink = std::function<void(int strip, const LidarReturn* points, std::size_t count)>;
  /// Points [from, to) of a chunk, all of one strip, with every field.
  struct Run {
    const PointChunk& chunk;
    std::size_t from, to;
    const TimeAlignment& time;  ///< to the time system of the trajectory

    LidarReturn point(std::size_t row) const;
  };
  using RunSink = std::function<void(int strip, const Run& run)>;

  /// Information about the flight, for choose().
  struct Flight {
    const Trajectory* trajectory = nullptr;
    std::optional<int> gps_week;
    /// Whether points without trajectory are left out; otherwise they are read.
    bool needed = true;
  };

  /// Reads all files once (ids, times, extents). InputError for a file that cannot be read,
  /// or that commonReference() refuses.
  /// \a threads: 0: all cores; results do not depend on it.
  /// \a window: the part of the files that is read; InputError where it has no points.
  /// \a processes: null, or those that share the readings (collective): each reads its share of
  /// the files and receives what the others found; see read().
  explicit SurveyReader(const std::vector<std::string>& paths, int threads = 0,
                        const PointWindow& window = {}, Communicator* processes = nullptr);
  /// The same from other sources than files.
  static SurveyReader ofInputs(std::vector<SurveyInput> inputs, int threads = 0);

  /// Chooses the points that are read, and their strips; without it all points are read, with
  /// strips named by StripNaming. Returns how times were reconciled with the trajectory, one line
  /// each. UsageError for an unknown strip, InputError where no point remains.
  std::vector<std::string> choose(const StripChoice& choice, const Flight& flight);

  const std::vector<std::string>& strips() const { return strips_; }
  /// Whether two strips were measured in one pass, as of scanners with numbers of their own; not so
  /// where strips are divided by channel, because these are to be compared.
  bool areOfOnePass(int a, int b) const {
    return channels_.empty() &&
           arrangement_->areOfOnePass(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }
  /// The field that divides strips by the channel of the scanner (PointWindow::channel_field);
  /// empty where they are not divided.
  std::string channelField() const;
  std::uint64_t pointCount() const;
  /// Approximate number of points of each strip.
  const std::vector<std::uint64_t>& pointsByStrip() const { return points_; }
  /// Points that the last complete reading left out.
  const std::vector<LeftOutPoints>& leftOut() const { return left_out_; }
  /// Common CRS of the files, and conversions or assumptions about their units.
  const PointReference& reference() const { return reference_; }
  /// Box of all points in plan, metres; empty when there are none.
  Eigen::AlignedBox2d extent() const;
  /// South-west corner of all points, metres.
  Eigen::Vector2d corner() const;
  /// North-east corner of all points, metres.
  Eigen::Vector2d farCorner() const;
  /// Finest coordinate step of the files, metres.
  double resolution() const;

  /// Times of the points of the strips in use, by file and point source id, on the clock of the
  /// trajectory.
  std::vector<TimeRange> observedTimes() const;

  const std::vector<SurveyedFile>& files() const { return files_; }
  const StripArrangement& arrangement() const { return *arrangement_; }

  /// Called during read() and readRuns(), by one thread at a time, with the share of the points
  /// that were read, 0 … 1; an exception of it ends the reading. Empty: none.
  void setProgress(std::function<void(double share)> progress) { progress_ = std::move(progress); }

  /** \brief Calls \a sink with all points, in runs of one strip; from several threads for
   * different strips.
   *
   * Collective where processes share the readings: each process gets all points of its own strips,
   * strips(), and none of the others.
   */
  void read(const Sink& sink) const { readRuns(asRuns(sink)); }
  /// The same with all fields of the points.
  void readRuns(const RunSink& sink) const;
  /// Collective: the first process gets all points of all strips, the others none.
  void readAtRoot(const Sink& sink) const { readRunsAtRoot(asRuns(sink)); }
  void readRunsAtRoot(const RunSink& sink) const;
  /// Not collective: this process gets all points of all strips, whatever the others do.
  void readAlone(const Sink& sink) const { readAllGroups(asRuns(sink)); }

  Communicator* processes() const { return processes_; }
  /// The strips by the process that reads them.
  SharedItems stripShares() const;

 private:
  SurveyReader(int threads, std::vector<SurveyInput> inputs, Communicator* processes);
  using Groups = std::vector<std::vector<std::size_t>>;
  /// Passes runs on as points.
  static RunSink asRuns(const Sink& sink);
  SharedItems sharesOf(const Groups& groups) const;
  /// Reads some groups of files and counts points by group and label.
  void readGroups(const Groups& groups, const std::vector<std::size_t>& chosen, const RunSink& sink,
                  std::vector<std::vector<std::uint64_t>>& counts) const;
  void alignTimes(const Flight& flight, std::vector<std::string>& remarks);
  void checkAnyLeft(const Flight& flight) const;
  /// Sets names, expected points and channels of the strips.
  void divide(bool by_channel);
  std::vector<std::set<std::uint8_t>> channelsByStrip() const;
  void readAllGroups(const RunSink& sink) const;
  /// Passes on a run of points of one strip of the arrangement, channel by channel.
  void passOn(int strip, const Run& run, const RunSink& sink) const;
  /// Adds the points of each label to \a counts.
  /// \a done: called with the number of points of every chunk.
  void readFile(std::size_t file, const RunSink& sink,
                const std::function<void(std::size_t points)>& done,
                std::vector<std::uint64_t>& counts) const;
  /// Files that have strips in common, by group.
  Groups groupsOfFiles() const;

  int threads_;
  Communicator* processes_;
  std::string channel_field_;
  std::vector<SurveyInput> inputs_;
  std::vector<SurveyedFile> files_;
  std::optional<StripArrangement> arrangement_;
  PointReference reference_;
  std::vector<TimeAlignment> times_;
  std::vector<std::string> strips_;
  std::vector<std::uint64_t> points_;
  /// Index of the strip of each channel of a strip of the arrangement; empty: one for all channels.
  std::vector<std::map<std::uint8_t, int>> channels_;
  std::function<void(double share)> progress_;
  mutable std::vector<LeftOutPoints> left_out_;
};

/// Reports the readings of a survey to the phases of a job as long as it exists.
class ReadingProgress {
 public:
  ReadingProgress(SurveyReader& survey, ProgressReport& progress) : survey_(survey) {
    survey_.setProgress([&progress](double share) { progress.advance(share); });
  }
  ~ReadingProgress() { survey_.setProgress({}); }
  ReadingProgress(const ReadingProgress&) = delete;
  ReadingProgress& operator=(const ReadingProgress&) = delete;

 private:
  SurveyReader& survey_;
};

}  // namespace pcl_als
