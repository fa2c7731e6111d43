// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/survey/strip_split.h>
#include <pcl_als/survey/surveyed_file.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// Index of the strip of that name; UsageError that names the option and lists the strips.
std::size_t stripNamed(const std::vector<std::string>& strips, const std::string& name,
                       const std::string& option);

/// Which of all strips a choice names; UsageError for a name that no strip has.
std::vector<bool> chosenStrips(const StripChoice& choice, const std::vector<std::string>& strips);

/// The trajectory and times to which points refer, if any.
struct FlownTimes {
  const Trajectory* trajectory = nullptr;
  /// By file; empty: the times of the points as stored. A file whose times cannot be reconciled
  /// with the trajectory has an alignment that leaves them outside it.
  std::vector<TimeAlignment> alignments;
  /// Exclude points that the trajectory does not cover, and points without a time.
  bool needed = true;
};

/** \brief Assigns each point of a set of files to a strip, or gives the reason why it is excluded.
 *
 * Without StripChoice::split, strips are those that the inputs name, else those of StripNaming.
 * With it, points of one point source id in all files are divided into stretches by splitTrack():
 * those of id 0 are named line1, line2, … in order of time, those of another id by the number where
 * there is one stretch, else 7.1, 7.2, …; files whose points have no times are not divided. With
 * StripChoice::divide_lines the same is done with single strips, whose names choose all of their
 * lines.
 *
 * Excluded are strips that were not chosen, points between lines (with split), points of GPS time 0
 * in a file that has times, and, where a trajectory is needed, points that it does not cover; a
 * strip of which it covers less than kLeastCovered is excluded as a whole.
 */
class StripAssignment {
 private:
  using Key = std::pair<std::size_t, std::uint16_t>;  ///< file, point source id
  /// Labels by time: each is valid from its time to that of the next one, the first from the
  /// beginning.
  struct Table {
    std::vector<std::pair<double, std::size_t>> from;
    std::optional<std::size_t> zero_time;
  };

 public:
  static constexpr double kLeastCovered = 0.05;  ///< share of a strip's points

  /// \param files must exist as long as this object. UsageError for names in \a choice that no
  /// strip has.
  StripAssignment(const std::vector<SurveyedFile>& files, const StripChoice& choice,
                  const FlownTimes& flown);

  std::size_t fileCount() const { return files_.size(); }
  /// The strips in use, in order of first appearance (with split: of id and time).
  const std::vector<std::string>& names() const { return names_; }
  /// What was divided although nobody asked for it, in a sentence for each strip.
  const std::vector<std::string>& divisions() const { return divisions_; }
  /// Whether two strips in use were measured in one pass: at least half of the seconds of one are
  /// also those of the other, as of scanners or tiles with ids of their own.
  bool areOfOnePass(std::size_t a, std::size_t b) const;
  /// Approximate number of points of each strip in use (bins on the border of the trajectory count
  /// as a whole).
  const std::vector<std::uint64_t>& expectedPoints() const { return expected_; }

  /// Label of a point: a strip in use, or the reason for which it is excluded.
  struct Label {
    std::string strip;
    int index = -1;  ///< among names(); -1: excluded
    ExclusionReason reason = ExclusionReason::excluded;
  };
  const std::vector<Label>& labels() const { return labels_; }
  /// The strips in use that may have points of that id in that file, as indices into names().
  std::vector<int> stripsOf(std::size_t file, std::uint16_t id) const;
  /// The points that were excluded, from the number of points of each label.
  std::vector<ExcludedPoints> excludedPoints(
      const std::vector<std::uint64_t>& points_of_label) const;

  /** \brief Labels the points of one file; not to be shared between threads. */
  class Assigner {
   public:
    Assigner(const StripAssignment& arrangement, std::size_t file);
    /// Index into labels() of a point with the file's own time. A time that is not finite is that
    /// of the strip's first point.
    std::size_t label(std::uint16_t id, double time);
    /// End of the run of points of one label that starts with \a from, and the label.
    std::pair<std::size_t, std::size_t> run(const PointChunk& chunk, std::size_t from);

   private:
    const StripAssignment& arrangement_;
    std::size_t file_;
    const TimeAlignment& alignment_;
    const Table* table_ = nullptr;
    std::uint16_t id_ = 0;
    double from_ = 0.0, until_ = 0.0;  ///< aligned times for which label_ is valid
    std::size_t label_ = 0;
  };

 private:
  struct Piece;

  std::vector<Piece> pieces(const StripChoice& choice);
  SwathTrack trackOf(const std::vector<Key>& keys) const;
  static void addLines(const std::string& strip, const std::vector<TimeStretch>& stretches,
                       const std::vector<Key>& keys, std::vector<Piece>& found);
  bool divide(const Piece& strip, std::vector<Piece>& found);
  static void checkNames(const StripChoice& choice, const std::vector<Piece>& all);
  void arrange(const Piece& piece, const StripChoice& choice);
  std::optional<ExclusionReason> exclusionReason(const Piece& piece, const StripChoice& choice,
                                                 std::uint64_t& covered) const;
  bool losesTimeless(const Key& key, const StripChoice& choice) const;
  std::size_t labelFor(const std::string& strip, std::optional<ExclusionReason> reason);
  double coveredShare(const Piece& piece, std::uint64_t& covered) const;
  void addCoverage(Table& table, const Piece& piece);

  const std::vector<SurveyedFile>& files_;
  FlownTimes flown_;
  TimeAlignment identity_;
  std::vector<std::string> names_;
  std::vector<std::uint64_t> expected_;
  std::vector<std::vector<std::int64_t>> seconds_;  ///< by strip in use: whole ones with points
  std::vector<std::string> divisions_;
  std::vector<Label> labels_;
  std::map<Key, Table> tables_;
};

}  // namespace pcl_als
