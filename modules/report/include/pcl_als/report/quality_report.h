// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/processing/checked_block.h>

namespace pcl_als {

class FieldTable;

/// Results of a delivery check (checkDelivery()) of one or two sets of strips.
struct QualityReport {
  CheckedBlock block;                  ///< the checked strips
  std::optional<CheckedBlock> before;  ///< the same strips before their correction, if checked
  int quality_level = 2;               ///< required quality level, 0 to 3
  double peak_memory_mb = 0.0;
};

/// A table of texts. If a row has fewer cells than the table, its last cell is a remark.
struct QualityTable {
  std::string caption;  ///< content of the table, with units
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> failed = {};  ///< indices of rows that fail the required quality level
};
/// The tables of heights, rigid motions, horizontal shifts, trends, and control if there is any.
std::vector<QualityTable> qualityTables(const QualityReport& report);

/// The tables and the conclusions from them, for a terminal.
std::string qualityText(const QualityReport& report);

/// The text of quality.json.
std::string qualityJson(const QualityReport& report);
/// The fields of quality.json with their meanings and units.
const FieldTable& qualityFields();

/// The tables of a check as CSV text by name: pairs, slope_aspect, profiles, offsets, run (times
/// and memory, which differ from run to run), and control if there is any.
std::map<std::string, std::string> qualityCsvTables(const QualityReport& report);
/// Writes quality.md and these tables as NAME.csv; each file appears only when it is complete.
void writeQualityTables(const std::filesystem::path& folder, const QualityReport& report);

/// Whether there is a reliable result: at least one measured pair or control point.
bool hasAnswer(const CheckedBlock& block);
/// The reason for which there is no reliable result, in one line; empty if there is one.
std::string whyUnreliable(const CheckedBlock& block);

/// Whether a pair was measured.
bool judged(const CheckedPair& pair);
/// The same pair in QualityReport::before; null if there is none.
const CheckedPair* pairBefore(const QualityReport& report, const CheckedPair& pair);

/// The name of a quality level: "QL1", or "none" if no level is satisfied.
std::string levelName(const std::optional<int>& level);

}  // namespace pcl_als
