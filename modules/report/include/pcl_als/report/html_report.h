// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/drawing/canvas.h>

namespace pcl_als {

/// A table of a report. Numbers are texts with the digits to be shown; an empty cell is shown as a
/// dash. If a row has fewer cells than the table, its last cell extends over the remaining columns.
struct ReportTable {
  std::string name;                  ///< the table is written to NAME.csv; empty: no file
  std::string caption;               ///< what the table shows, with units
  std::vector<std::string> columns;  ///< headings
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> failed = {};  ///< indices of rows that exceed a limit and are marked
};

/// Grade of the verdict of a report, shown by its colour.
enum class VerdictGrade { good, attention, bad };

/** \brief A report as one self-contained HTML page with its pictures, and without them as Markdown
 * and CSV.
 *
 * The page needs no network and has a table of contents and a style for printing. Its script sorts
 * tables and filters long ones; without it the page is complete. All texts are escaped.
 * \code
 * pcl_als::HtmlReport report("Calibration of block 7", "pcl_als_calibrate 0.2.0");
 * report.setVerdict(pcl_als::VerdictGrade::good, "The strips agree to 2.1 cm.");
 * report.addVerdict("Boresight roll is −90.1 ± 0.8 arcsec.");
 * report.addSection("Pairs of strips");
 * report.addTable({"pairs", "Normal distances, m", {"pair", "before", "after"}, rows});
 * report.addPicture(pcl_als::drawCurves(plot), "RMS of each pair before and after");
 * report.addSetting("range_noise", "0.02 m");
 * report.addInput("strip1.las");
 * report.write("report");  // report/report.html, report/report.md, report/pairs.csv
 * \endcode
 */
class HtmlReport {
 public:
  /// \param tool name and version of the program
  HtmlReport(std::string title, std::string tool);

  void setVerdict(VerdictGrade grade, std::string headline);
  void addVerdict(std::string sentence);  ///< plain words below the headline

  void addSection(std::string heading);
  void addText(std::string paragraph);
  void addList(std::vector<std::string> items);
  void addTable(ReportTable table);
  /// The caption is also the alternative text of the picture.
  void addPicture(const Canvas& picture, const std::string& caption);

  void addSetting(std::string name, std::string value);
  /// Lists an input with its size and time of modification; a missing file is listed as missing.
  void addInput(const std::filesystem::path& path);

  std::string html() const;
  std::string markdown() const;
  /// Writes report.html, report.md and the tables as CSV into a folder, which is created if it does
  /// not exist. InputError if a file cannot be written.
  void write(const std::filesystem::path& folder) const;

 private:
  enum class Kind { heading, text, list, table, picture };
  struct Block {
    Kind kind;
    std::string text;
    std::vector<std::string> items;
    ReportTable table;
    std::string svg;
  };
  struct Input {
    std::string path, size, time;
  };
  std::string htmlOf(const Block& block) const;
  std::string contents() const;
  std::string appendix() const;
  ReportTable settingsTable() const;
  ReportTable inputsTable() const;

  std::string title_, tool_, made_, headline_;
  VerdictGrade grade_ = VerdictGrade::attention;
  std::vector<std::string> verdict_;
  std::vector<Block> blocks_;
  std::vector<std::vector<std::string>> settings_;
  std::vector<Input> inputs_;
};

}  // namespace pcl_als
