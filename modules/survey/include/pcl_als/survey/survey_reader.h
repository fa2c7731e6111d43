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

/** \brief The points of a survey as strips, from files or clouds, which can be read repeatedly.
 *
 * All jobs on strips read their points through this class; a "file" is any SurveyInput, such as a
 * cloud from makeCloudInput().
 *
 * Strips are those of StripAssignment, divided by the channel of the scanner where
 * StripChoice::by_channel asks for it; points that it excludes are counted and not passed on.
 *
 * Points are columns of a PointChunk: positions in metres in the ground frame (the CRS of
 * reference()), times in seconds as the file counts them, with the conversion to the clock of the
 * trajectory beside them (Run::time), intensities in digital numbers, angles in degrees.
 *
 * Order: the points of a strip come in the order of the files and of the points in them. Files that
 * share a strip are read one after the other, others in parallel, so that the order does not depend
 * on the number of threads; with one thread all files are read in their order.
 *
 * Memory: a chunk (131,072 points, 8 MB) for each thread, and SwathTrack for each point source id
 * of a file.
 */
class SurveyReader {
 public:
  /// Points [from, to) of a chunk, all of one strip, with every field.
  struct Run {
    int strip;          ///< index among strips(); -1: excluded (runAt() only)
    std::size_t label;  ///< index among StripAssignment::labels()
    std::size_t file;   ///< index among files()
    const PointChunk& chunk;
    std::size_t from, to;
    const TimeAlignment& time;  ///< to the time system of the trajectory

    Eigen::Vector3d position(std::size_t row) const {
      return {chunk.x[row], chunk.y[row], chunk.z[row]};
    }
    LidarReturn point(std::size_t row) const { return chunk.point(row, time(chunk.gps_time[row])); }
    /// All of them, in place of what \a points holds.
    void points(std::vector<LidarReturn>& points) const;
  };
  using Visitor = std::function<void(const Run& run)>;
  using Sink = std::function<void(int strip, const LidarReturn* points, std::size_t count)>;
  /// Passes runs on as points, for jobs that keep these in areas.
  static Visitor asReturns(Sink sink);

  /// Information about the flight, for choose().
  struct Flight {
    const Trajectory* trajectory = nullptr;
    std::optional<int> gps_week;
    /// Whether points without trajectory are excluded; otherwise they are read.
    bool needed = true;
  };

  /// Reads all files once (ids, times, extents). InputError for a file that cannot be read,
  /// or that commonReference() refuses.
  /// \a threads: 0: all cores; results do not depend on it.
  /// \a window: the part of the files that is read; InputError where it has no points.
  /// \a processes: null, or those that share the readings (collective): each reads its share of
  /// the files and receives what the others found; see Reading::Share.
  explicit SurveyReader(const std::vector<std::string>& paths, int threads = 0,
                        const PointWindow& window = {}, Communicator* processes = nullptr);
  /// The same from other sources than files.
  static SurveyReader ofInputs(std::vector<SurveyInput> inputs, int threads = 0);
  /// Files that may be in different coordinate reference systems: reference() is empty.
  static SurveyReader ofFiles(const std::vector<std::filesystem::path>& paths, int threads = 0,
                              const PointWindow& window = {});
  /// Each file is a strip of its own with all of its points; nothing is read before read(), and
  /// there is no arrangement(). \a files: as their headers state, or measured.
  static SurveyReader ofWholeFiles(const std::vector<PointFileInfo>& files, int threads = 0,
                                   const PointWindow& window = {});
  /// Files that a job has surveyed and whose times it has aligned in a way of its own: the points
  /// of \a choice, without choose().
  static SurveyReader ofSurveyed(std::vector<SurveyedFile> files, const StripChoice& choice,
                                 const FlownTimes& flown, int threads = 0);
  SurveyReader(SurveyReader&& other) noexcept;
  SurveyReader& operator=(SurveyReader&& other) noexcept;
  ~SurveyReader();

  /// Chooses the points that are read, and their strips; without it all points are read, with
  /// strips named by StripNaming. Returns how times were reconciled with the trajectory, one line
  /// each. UsageError for an unknown strip, InputError where no point remains.
  std::vector<std::string> choose(const StripChoice& choice, const Flight& flight);

  const std::vector<std::string>& strips() const { return strips_; }
  /// Whether two strips were measured in one pass, as of scanners with numbers of their own; not so
  /// where strips are divided by channel, because these are to be compared.
  bool areOfOnePass(int a, int b) const;
  /// The field that divides strips by the channel of the scanner (PointWindow::channel_field);
  /// empty where they are not divided.
  std::string channelField() const;
  std::uint64_t pointCount() const;
  /// Approximate number of points of each strip.
  const std::vector<std::uint64_t>& pointsByStrip() const { return points_; }
  /// Common CRS of the files, and conversions or assumptions about their units.
  const PointReference& reference() const { return reference_; }
  /// Box of all points in plan, metres; empty when there are none.
  Eigen::AlignedBox2d extent() const;
  /// South-west corner of all points, metres; the origin where there are none.
  Eigen::Vector2d corner() const;
  /// North-east corner, likewise.
  Eigen::Vector2d farCorner() const;
  /// Finest coordinate step of the files, metres.
  double resolution() const;

  /// Times of the points of the strips in use, by file and point source id, on the clock of the
  /// trajectory.
  std::vector<TimeRange> observedTimes() const;

  const std::vector<SurveyedFile>& files() const { return *files_; }
  const StripAssignment& arrangement() const { return *arrangement_; }

  /// Called during read(), by one thread at a time, with the share of the points that were read,
  /// 0 … 1; an exception of it ends the reading. Empty: none.
  void setProgress(std::function<void(double share)> progress) { progress_ = std::move(progress); }

  /// Which points a reading gives.
  struct Reading {
    /// own: each process gets all points of its own strips and none of the others (collective).
    /// all: this process gets all points of all strips, whatever the others do.
    /// first: the first process gets all points of all strips, the others none (collective);
    /// only the first one learns which points were excluded.
    enum class Share { own, all, first };
    Share share = Share::own;
    std::vector<std::size_t> files;  ///< indices of the files that are read; empty: all
    int strip = -1;                  ///< the only strip that is read; -1: all
    std::string extra_field;         ///< values of PointChunk::extra; empty: none
    std::optional<int> threads;      ///< in place of those of the reader

    static Reading by(Share share) {
      Reading reading;
      reading.share = share;
      return reading;
    }
  };
  /** \brief Calls \a visit with all points, in runs of one strip; from several threads for
   * different strips. Returns the points that were excluded.
   *
   * May be called by several threads at once, where no progress is set.
   */
  std::vector<ExcludedPoints> read(const Visitor& visit, const Reading& reading) const;
  std::vector<ExcludedPoints> read(const Visitor& visit) const { return read(visit, Reading()); }

  /// The points of each strip, and those that are excluded.
  struct Contents {
    std::vector<std::uint64_t> points;       ///< by strip
    std::vector<Eigen::AlignedBox3d> boxes;  ///< of these, metres
    std::vector<ExcludedPoints> excluded;

    std::uint64_t pointCount() const;
    Eigen::AlignedBox3d box() const;
  };
  /// Reads all points.
  Contents measure() const;

  /// The run that begins with a row of a chunk of a file, also of points that are excluded, for
  /// jobs that rewrite files; strips are not divided by channel. Thread-safe.
  Run runAt(std::size_t file, const PointChunk& chunk, std::size_t from) const;

  Communicator* processes() const { return processes_; }
  /// The strips by the process that reads them.
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

/// Receives the points that a job reads, for further maps and statistics; both may be empty.
struct SurveyObserver {
  /// Called when the strips have been chosen.
  std::function<void(const SurveyReader& survey)> begin;
  /// All points of one reading; from several threads for different strips.
  SurveyReader::Sink points;
};

}  // namespace pcl_als
