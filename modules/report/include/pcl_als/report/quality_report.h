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

/// The two sets of a check; before: empty when there is one set only.
struct QualityReport {
  CheckedBlock block;
  std::optional<CheckedBlock> before;
  int quality_level = 2;  ///< required quality level
  double peak_memory_mb = 0.0;
};

/// A table of text. A row may end early, with a remark in place of its other cells.
struct QualityTable {
  std::string caption;  ///< its content, with units
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> failed = {};  ///< rows that do not keep the required quality level
};
/// Heights, movements, shifts, trends, and control where it was given.
std::vector<QualityTable> qualityTables(const QualityReport& report);

/// The tables and the conclusions from them, for a terminal.
std::string qualityText(const QualityReport& report);

/// The text of quality.json.
std::string qualityJson(const QualityReport& report);
/// The description of quality.json.
const FieldTable& qualityFields();

/// The tables of a check as CSV by name: pairs, slope_aspect, profiles, offsets, run (times and
/// memory, which differ from run to run), and control where it was given.
std::map<std::string, std::string> qualityCsvTables(const QualityReport& report);
/// Writes quality.md and these tables as NAME.csv, each complete or not at all.
void writeQualityTables(const std::filesystem::path& folder, const QualityReport& report);

/// Whether there is a reliable result: an assessed pair, or a control point.
bool hasAnswer(const CheckedBlock& block);
/// The reason for which there is no reliable result, in one line; empty where there is one.
std::string whyUnreliable(const CheckedBlock& block);

bool judged(const CheckedPair& pair);
/// The same pair in the set before; null where there is none.
const CheckedPair* pairBefore(const QualityReport& report, const CheckedPair& pair);

/// "QL1", or "none" where no level is satisfied.
std::string levelName(const std::optional<int>& level);

}  // namespace pcl_als
