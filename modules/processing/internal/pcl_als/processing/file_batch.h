// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/processing/batch_options.h>

namespace pcl_als {

/** \brief The files of a job that makes an output of every input, divided among processes by size.
 * Outputs are in the order of the inputs.
 */
class FileBatch {
 public:
  /// UsageError unless there is one output for each input, of different names, and none of them is
  /// an input, which stays protected while the object exists.
  FileBatch(std::vector<std::string> inputs, std::vector<std::string> outputs,
            const BatchOptions& options);

  const std::vector<std::string>& inputs() const { return inputs_; }
  const std::vector<std::string>& outputs() const { return outputs_; }
  /// Whether an earlier run completed an output; after run().
  bool wasKept(std::size_t file) const { return kept_[file] != 0; }
  std::size_t keptCount() const;

  /// Writes the output of a file, tells the fraction that is done and returns its result as bytes.
  using Work =
      std::function<std::string(std::size_t file, const std::function<void(double)>& fraction)>;
  /** \brief Collective: does the work for all files that are not complete, in each process for its
   * share, one file after another. Returns the results of all files, from records for those that
   * were kept. \a progress receives the fraction of the bytes that this process has done.
   * \a given: the division of the files; null: by size, without those that are kept.
   */
  std::vector<std::string> run(const Work& work, const std::function<void(double)>& progress,
                               const SharedItems* given = nullptr);

 private:
  void removeTemporaries() const;
  std::string identity(std::size_t file) const;
  std::filesystem::path recordOf(std::size_t file) const;
  void readRecords(std::vector<std::string>& results);
  bool readRecord(std::size_t file, std::string& result) const;
  void writeRecord(std::size_t file, const std::string& result) const;

  std::vector<std::string> inputs_, outputs_;
  FileProtection protection_;
  BatchOptions options_;
  std::vector<char> kept_;
};

/// "FOLDER/name" for each input. UsageError where two inputs have the same name.
std::vector<std::string> outputsIn(const std::filesystem::path& folder,
                                   const std::vector<std::string>& inputs);

/// BatchOptions::settings of a program: its name and version, and its settings (name, value) but
/// those \a without_effect; files that a value names are followed by their size and time.
std::string settingsText(const std::string& program,
                         const std::vector<std::pair<std::string, std::string>>& settings,
                         const std::set<std::string>& without_effect);

}  // namespace pcl_als
