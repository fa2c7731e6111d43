// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <iterator>
#include <sstream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/processing/file_batch.h>

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordFormat = "pcl_als record 1";

/// A file as it was seen: path, size, time of modification.
void describeFile(const fs::path& path, ByteWriter& out) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  const auto time = fs::last_write_time(path, error);
  out.put(fs::absolute(path).lexically_normal().string());
  out.put(error ? std::uintmax_t{0} : size);
  out.put(error ? fs::file_time_type::rep{0} : time.time_since_epoch().count());
}

/// The name that a temporary file of AtomicFile becomes; empty for other names.
std::string targetOfTemporary(const std::string& name) {
  const std::string tail = ".partial";
  if (name.size() <= tail.size() || name.substr(name.size() - tail.size()) != tail) return {};
  const std::string stem = name.substr(0, name.size() - tail.size());
  const std::size_t dot = stem.rfind('.');
  if (dot == std::string::npos || dot + 1 == stem.size()) return {};
  return stem.find_first_not_of("0123456789-", dot + 1) == std::string::npos ? stem.substr(0, dot)
                                                                             : std::string();
}

}  // namespace

FileBatch::FileBatch(std::vector<std::string> inputs, std::vector<std::string> outputs,
                     const BatchOptions& options)
    : inputs_(std::move(inputs)),
      outputs_(std::move(outputs)),
      protection_(inputs_),
      options_(options),
      kept_(inputs_.size(), 0) {
  if (inputs_.size() != outputs_.size())
    throw UsageError("there must be one output for each input");
  std::set<std::string> names;
  for (const std::string& output : outputs_) {
    if (!names.insert(output).second) throw UsageError("two inputs would become " + output);
    protection_.check(output);
  }
}

std::size_t FileBatch::keptCount() const {
  return static_cast<std::size_t>(std::count(kept_.begin(), kept_.end(), 1));
}

void FileBatch::removeTemporaries() const {
  std::set<fs::path> folders;
  std::set<std::string> names;
  for (std::size_t file = 0; file < outputs_.size(); ++file) {
    for (const fs::path& path : {fs::absolute(outputs_[file]), recordOf(file)}) {
      names.insert(path.filename().string());
      folders.insert(path.parent_path());
    }
  }
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (names.count(targetOfTemporary(entry.path().filename().string())) == 0) continue;
      std::error_code gone;
      fs::remove(entry.path(), gone);
    }
  }
}

std::string FileBatch::identity(std::size_t file) const {
  ByteWriter out;
  out.put(std::string(kRecordFormat)).put(options_.settings);
  describeFile(inputs_[file], out);
  for (std::size_t other = 0; options_.joint && other < inputs_.size(); ++other)
    describeFile(inputs_[other], out);
  describeFile(outputs_[file], out);
  return out.take();
}

fs::path FileBatch::recordOf(std::size_t file) const {
  const fs::path output = fs::absolute(outputs_[file]);
  return output.parent_path() / BatchOptions::kRecords / (output.filename().string() + ".record");
}

bool FileBatch::readRecord(std::size_t file, std::string& result) const {
  if (!fs::exists(outputs_[file]) || !fs::exists(recordOf(file))) return false;
  const std::string bytes = readWholeFile(recordOf(file), kBinaryLimits);
  const std::string wanted = identity(file);
  if (bytes.compare(0, wanted.size(), wanted) != 0) return false;
  result = bytes.substr(wanted.size());
  return true;
}

void FileBatch::writeRecord(std::size_t file, const std::string& result) const {
  fs::create_directories(recordOf(file).parent_path());
  writeFile(recordOf(file), identity(file) + result);
}

void FileBatch::readRecords(std::vector<std::string>& results) {
  ByteWriter records;
  doTogether(options_.processes, [&] {
    if (options_.processes != nullptr && !options_.processes->isRoot()) return;
    removeTemporaries();
    for (std::size_t file = 0; file < inputs_.size(); ++file)
      kept_[file] = readRecord(file, results[file]) ? 1 : 0;
    records.put(kept_).put(results);
  });
  if (options_.processes == nullptr) return;
  // One process decides: network file systems may tell others of older states.
  const std::string of_root = options_.processes->gatherAll(records.bytes()).front();
  ByteReader(of_root).get(kept_).get(results);
}

std::vector<std::string> FileBatch::run(const Work& work,
                                        const std::function<void(double)>& progress,
                                        const SharedItems* given) {
  std::vector<std::string> results(inputs_.size());
  if (options_.resume) readRecords(results);
  std::vector<double> costs;
  for (std::size_t file = 0; file < inputs_.size(); ++file) {
    std::error_code absent;
    const auto size = fs::file_size(inputs_[file], absent);
    costs.push_back(absent || kept_[file] != 0 ? 0.0 : static_cast<double>(size));
  }
  const SharedItems items = given == nullptr ? SharedItems(options_.processes, costs) : *given;
  double all = 1e-9, done = 0.0;
  for (const std::size_t file : items.ownItems()) all += costs[file];
  doTogether(options_.processes, [&] {
    for (const std::size_t file : items.ownItems()) {
      if (kept_[file] != 0) continue;
      results[file] = work(file, [&](double part) { progress((done + part * costs[file]) / all); });
      if (options_.resume) writeRecord(file, results[file]);
      done += costs[file];
    }
  });
  shareBytes(options_.processes, items, results);
  return results;
}

std::vector<std::string> outputsIn(const fs::path& folder, const std::vector<std::string>& inputs) {
  std::vector<std::string> outputs;
  for (const std::string& input : inputs) {
    outputs.push_back((folder / fs::path(input).filename()).string());
    if (std::count(outputs.begin(), outputs.end(), outputs.back()) > 1)
      throw UsageError("two inputs would become " + outputs.back());
  }
  return outputs;
}

std::string settingsText(const std::string& program,
                         const std::vector<std::pair<std::string, std::string>>& settings,
                         const std::set<std::string>& without_effect) {
  std::ostringstream text;
  text << program;
  for (const auto& [name, value] : settings) {
    if (without_effect.count(name) != 0) continue;
    text << '\n' << name << '=' << value;
    for (const std::string& part : splitList(value)) {
      std::error_code none;
      if (!std::filesystem::is_regular_file(part, none)) continue;
      text << ' ' << std::filesystem::file_size(part, none) << ' '
           << std::filesystem::last_write_time(part, none).time_since_epoch().count();
    }
  }
  return text.str();
}

}  // namespace pcl_als
