// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/survey/survey_input.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

class Communicator;
struct FlownTimes;
class SharedItems;
class StripAssignment;
struct SurveyedFile;

/** \brief Presents the points of a block, from files or clouds, as strips that can be read
 * repeatedly.
 *
 * All jobs on strips read their points through this class. A "file" is any SurveyInput, such as a
 * cloud from makeCloudInput().
 *
 * Strips are those of StripAssignment, on request divided by the channel of the scanner
 * (StripChoice::by_channel). Excluded points are counted and not passed on.
 *
 * Points are columns of a PointChunk: positions in metres in the ground frame (the CRS of
 * reference()), times in seconds as in the file, intensities as digital numbers, angles in degrees.
 * Run::time converts the times to those of the trajectory.
 *
 * The points of a strip come in the order of the files and of the points in them. Files that
 * contain points of the same strip are read one after the other, other files in parallel, so that
 * this order does not depend on the number of threads. With one thread all files are read in order.
 *
 * Memory: a chunk (131,072 points, 8 MB) for each thread, and a SwathTrack for each point source id
 * of a file. A file that changes or cannot be read is an InputError.
 * \code
 * pcl_als::SurveyReader survey({"strip1.las", "strip2.las"});
 * survey.read([](const pcl_als::SurveyReader::Run& run) {  // by several threads
 *   for (std::size_t row = run.from; row < run.to; ++row) use(run.strip, run.position(row));
 * });
 * \endcode
 */
class SurveyReader {
 public:
  /// Points [from, to) of a chunk, all of one strip, with all fields.
  struct Run {
    int strip;          ///< index among strips(); -1: excluded (runAt() only)
    std::size_t label;  ///< index among StripAssignment::labels()
    std::size_t file;   ///< index among files()
    const PointChunk& chunk;
    std::size_t from, to;
    const TimeAlignment& time;  ///< to the time system of the trajectory

    /// Metres, ground frame.
    Eigen::Vector3d position(std::size_t row) const {
      return {chunk.x[row], chunk.y[row], chunk.z[row]};
    }
    LidarReturn point(std::size_t row) const { return chunk.point(row, time(chunk.gps_time[row])); }
    /// Replaces the contents of \a points by the points of the run.
    void points(std::vector<LidarReturn>& points) const;
  };
  using Visitor = std::function<void(const Run& run)>;
  using Sink = std::function<void(int strip, const LidarReturn* points, std::size_t count)>;
  /// A visitor that converts runs to points and passes them to \a sink.
  static Visitor asReturns(Sink sink);

  /// Information about the flight, for choose().
  struct Flight {
    const Trajectory* trajectory = nullptr;
    std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
    /// Whether points that the trajectory does not cover are excluded.
    bool needed = true;
  };

  /// Reads all files once (ids, times, extents). InputError for files that cannot be read or whose
  /// CRS or units do not agree (commonReference()).
  /// \param threads 0: all cores; results do not depend on it
  /// \param window the part of the files that is read; InputError if it contains no points
  /// \param processes null, or the processes that share the readings (collective): each reads its
  /// share of the files and receives the results of the others, see Reading::Share
  explicit SurveyReader(const std::vector<std::string>& paths, int threads = 0,
                        const PointWindow& window = {}, Communicator* processes = nullptr);
  /// A reader of other sources than files.
  static SurveyReader ofInputs(std::vector<SurveyInput> inputs, int threads = 0);
  /// A reader of files that may be in different coordinate reference systems; reference() is empty.
  static SurveyReader ofFiles(const std::vector<std::filesystem::path>& paths, int threads = 0,
                              const PointWindow& window = {});
  /// A reader in which each file is a strip with all of its points. Nothing is read before read(),
  /// and arrangement() must not be called. \a files: from the headers of the files, or measured.
  static SurveyReader ofWholeFiles(const std::vector<PointFileInfo>& files, int threads = 0,
                                   const PointWindow& window = {});
  /// A reader of the points of \a choice in files that a job has already indexed (surveyFile()) and
  /// whose times it has aligned; choose() is not called.
  static SurveyReader ofSurveyed(std::vector<SurveyedFile> files, const StripChoice& choice,
                                 const FlownTimes& flown, int threads = 0);
  SurveyReader(SurveyReader&& other) noexcept;
  SurveyReader& operator=(SurveyReader&& other) noexcept;
  ~SurveyReader();

  /// Chooses the strips and points that are read. If it is not called, all points are read, and
  /// strips are named by StripNaming. Returns one line for each way in which times were reconciled
  /// with the trajectory. UsageError for an unknown strip, InputError if no point remains.
  std::vector<std::string> choose(const StripChoice& choice, const Flight& flight);

  const std::vector<std::string>& strips() const { return strips_; }
  /// Whether two strips were measured in one pass, such as those of two scanners of one aircraft.
  /// False if strips are divided by channel, because channels are to be compared.
  bool areOfOnePass(int a, int b) const;
  /// The field that divides strips by scanner channel (PointWindow::channel_field); empty if they
  /// are not divided.
  std::string channelField() const;
  std::uint64_t pointCount() const;  ///< of all files, including excluded points
  /// Approximate number of points of each strip.
  const std::vector<std::uint64_t>& pointsByStrip() const { return points_; }
  /// Common CRS of the files, with conversions of their units and assumptions about them.
  const PointReference& reference() const { return reference_; }
  /// Box of all points in plan, metres; empty when there are none.
  Eigen::AlignedBox2d extent() const;
  /// South-west corner of all points, metres; the origin if there are none.
  Eigen::Vector2d corner() const;
  /// North-east corner of all points, metres; the origin if there are none.
  Eigen::Vector2d farCorner() const;
  /// Finest step of the plan coordinates of the files, limited to 0.1 to 10 mm; metres.
  double resolution() const;

  /// Times of the points of the strips in use, by file and point source id, on the clock of the
  /// trajectory.
  std::vector<TimeRange> observedTimes() const;

  const std::vector<SurveyedFile>& files() const { return *files_; }
  /// The assignment of the points to strips.
  const StripAssignment& arrangement() const { return *arrangement_; }

  /// Sets a function that read() calls, by one thread at a time, with the share of the points that
  /// were read, 0 … 1. An exception that it throws ends the reading. Empty: none.
  void setProgress(std::function<void(double share)> progress) { progress_ = std::move(progress); }

  /// The points that are read.
  struct Reading {
    /// own: each process gets all points of its own strips and none of the others (collective).
    /// all: this process gets all points of all strips, whatever the others do.
    /// first: the first process gets all points of all strips, the others none (collective); only
    /// the first process receives the excluded points.
    enum class Share { own, all, first };
    Share share = Share::own;
    std::vector<std::size_t> files;  ///< indices of the files that are read; empty: all
    int strip = -1;                  ///< the only strip that is read; -1: all
    std::string extra_field;         ///< extra-bytes field for PointChunk::extra; empty: none
    std::optional<int> threads;      ///< replaces the number of threads of the reader

    static Reading by(Share share) {
      Reading reading;
      reading.share = share;
      return reading;
    }
  };
  /** \brief Calls \a visit with all points, in runs of one strip, and returns the excluded points.
   *
   * Several threads call \a visit at the same time, but never for the same strip. read() itself may
   * be called by several threads at once if no progress function is set.
   */
  std::vector<ExcludedPoints> read(const Visitor& visit, const Reading& reading) const;
  std::vector<ExcludedPoints> read(const Visitor& visit) const { return read(visit, Reading()); }

  /// Numbers and extents of the points of each strip, and the excluded points.
  struct Contents {
    std::vector<std::uint64_t> points;       ///< by strip
    std::vector<Eigen::AlignedBox3d> boxes;  ///< by strip, metres, ground frame
    std::vector<ExcludedPoints> excluded;

    std::uint64_t pointCount() const;
    Eigen::AlignedBox3d box() const;
  };
  /// Reads all points and measures them.
  Contents measure() const;

  /// The run of points of one strip, or of excluded points, that begins at row \a from of a chunk
  /// of a file, for jobs that rewrite files. Strips are not divided by channel. Thread-safe.
  Run runAt(std::size_t file, const PointChunk& chunk, std::size_t from) const;

  Communicator* processes() const { return processes_; }
  /// The division of the strips among the processes.
  SharedItems stripShares() const;

 private:
  SurveyReader(std::vector<SurveyedFile> files, int threads, const PointWindow& window);
  SurveyReader(int threads, std::vector<SurveyInput> inputs, Communicator* processes);
  using Groups = std::vector<std::vector<std::size_t>>;
  using LabelCounts = std::vector<std::uint64_t>;

  void setReference();
  void requireAny(const PointWindow& window) const;
  void alignTimes(const Flight& flight, std::vector<std::string>& remarks);
  void checkAnyLeft(const Flight& flight) const;
  /// Sets names, expected points and channels of the strips.
  void divide(bool by_channel);
  std::vector<std::set<std::uint8_t>> channelsByStrip() const;
  /// The strips that may have points in a file.
  std::set<int> stripsIn(std::size_t file) const;
  /// Files that have strips in common, by group.
  Groups groupsOfFiles() const;
  std::vector<std::size_t> filesOf(const Reading& reading) const;
  /// Groups of these files.
  Groups groupsOf(const Reading& reading, bool one_after_the_other) const;
  SharedItems sharesOf(const Groups& groups, Communicator* processes) const;
  std::vector<ExcludedPoints> readByFirst(const Visitor& visit, Reading reading) const;
  /// Reads some groups of files and counts points by group and label.
  void readGroups(const Groups& groups, const std::vector<std::size_t>& chosen,
                  const Visitor& visit, const Reading& reading,
                  std::vector<LabelCounts>& counts) const;
  /// \a done: called with the number of points of every chunk.
  void readFile(std::size_t file, const Visitor& visit, const Reading& reading,
                const std::function<void(std::size_t points)>& done, LabelCounts& counts) const;
  /// Passes on a run of points of one strip of the arrangement, channel by channel.
  void passOn(const Run& run, const Visitor& visit, int only) const;

  int threads_ = 0;
  Communicator* processes_ = nullptr;
  std::string channel_field_;
  std::vector<SurveyInput> inputs_;
  /// The arrangement refers to it; in its place when the reader is moved.
  std::unique_ptr<std::vector<SurveyedFile>> files_;
  std::unique_ptr<StripAssignment> arrangement_;
  PointReference reference_;
  std::vector<TimeAlignment> times_;
  std::vector<std::string> strips_;
  std::vector<std::uint64_t> points_;
  /// Index of the strip of each channel of a strip of the arrangement; empty: one for all channels.
  std::vector<std::map<std::uint8_t, int>> channels_;
  std::function<void(double share)> progress_;
};

/// Reports the progress of the readings of a survey to a job as long as this object exists.
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

/// Receives the points that a job reads, for maps and statistics. Both functions may be empty.
struct SurveyObserver {
  /// Called when the strips have been chosen.
  std::function<void(const SurveyReader& survey)> begin;
  /// Called with all points of one reading, by several threads for different strips.
  SurveyReader::Sink points;
};

}  // namespace pcl_als
