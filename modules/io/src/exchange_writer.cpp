// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <charconv>
#include <cstring>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/exchange_writer.h>

namespace pcl_als {
namespace {

/// The fields of a record in their order, with their types in PLY.
struct ExchangeField {
  const char *name, *type;
};
constexpr ExchangeField kPlaceFields[] = {{"x", "double"}, {"y", "double"}, {"z", "double"}};
constexpr ExchangeField kTimeField = {"gps_time", "double"};
constexpr ExchangeField kOtherFields[] = {
    {"intensity", "float"},     {"scan_angle", "float"},        {"point_source_id", "ushort"},
    {"return_number", "uchar"}, {"number_of_returns", "uchar"}, {"classification", "uchar"},
    {"flags", "uchar"},         {"user_data", "uchar"}};

/// A comment must stay one line.
std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::vector<ExchangeField> fieldsOf(bool with_time) {
  std::vector<ExchangeField> fields(std::begin(kPlaceFields), std::end(kPlaceFields));
  if (with_time) fields.push_back(kTimeField);
  fields.insert(fields.end(), std::begin(kOtherFields), std::end(kOtherFields));
  return fields;
}

/// Packs values of a record.
class BinaryRow {
 public:
  explicit BinaryRow(std::string& out) : out_(out) {}
  void place(double value) { put(value); }
  template <typename T>
  void put(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out_.append(bytes, sizeof value);
  }
  void end() {}

 private:
  std::string& out_;
};

/// Writes values of a record as a line: the shortest digits that read back to the same value.
class TextRow {
 public:
  TextRow(std::string& out, int decimals) : out_(out), decimals_(decimals) {}
  void place(double value) {
    char text[400];
    const auto end =
        std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals_).ptr;
    add(text, end);
  }
  template <typename T>
  void put(T value) {
    char text[64];
    if constexpr (std::is_floating_point_v<T>)
      add(text, std::to_chars(text, text + sizeof text, value).ptr);
    else
      add(text, std::to_chars(text, text + sizeof text, static_cast<unsigned>(value)).ptr);
  }
  void end() { out_.back() = '\n'; }

 private:
  void add(const char* text, const char* end) {
    out_.append(text, end);
    out_ += ' ';
  }
  std::string& out_;
  int decimals_;
};

template <typename Row>
void putRow(const PointChunk& chunk, std::size_t i, bool with_time, Row row) {
  row.place(chunk.x[i]), row.place(chunk.y[i]), row.place(chunk.z[i]);
  if (with_time) row.put(chunk.gps_time[i]);
  row.put(chunk.intensity[i]), row.put(chunk.scan_angle[i]);
  row.put(chunk.point_source_id[i]);
  row.put(chunk.return_number[i]), row.put(chunk.number_of_returns[i]);
  row.put(chunk.classification[i]), row.put(chunk.flags[i]), row.put(chunk.user_data[i]);
  row.end();
}

}  // namespace

struct ExchangeWriter::State {
  AtomicFile file;
  std::string comments;  ///< "# pcl_als crs …" lines
  bool ply, ascii, with_time;
  int decimals;
  std::uint64_t count = 0;
  std::string block;

  State(const std::filesystem::path& path, const PointFileInfo& info, const Options& options)
      : file(path),
        ply(lowerExtension(path) == ".ply"),
        ascii(!ply || options.ascii_ply),
        with_time(info.time_kind != TimeKind::none) {
    constexpr int kMostDecimals = 9;
    decimals = std::clamp(decimalsOf(info.resolution.minCoeff()), 0, kMostDecimals);
    const std::pair<const char*, std::string> known[] = {
        {"strip", options.strip_id}, {"crs", info.crs}, {"corrections", info.corrections}};
    for (const auto& [key, value] : known)
      if (!value.empty()) comments += std::string("# pcl_als ") + key + " " + oneLine(value) + '\n';
  }

  /// Text of the same length whatever the count, which is stored at the end.
  std::string plyHeader() const {
    constexpr std::size_t kLongestCount = 20;
    const std::string vertices = std::to_string(count);
    std::string text = std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") +
                       " 1.0\ncomment pcl_als" + std::string(kLongestCount - vertices.size(), ' ') +
                       "\n";
    for (std::size_t at = 0; at < comments.size();) {
      const std::size_t end = comments.find('\n', at) + 1;
      text += "comment" + comments.substr(at + 1, end - at - 1);
      at = end;
    }
    text += "element vertex " + vertices + '\n';
    for (const ExchangeField& field : fieldsOf(with_time))
      text += std::string("property ") + field.type + ' ' + field.name + '\n';
    return text + "end_header\n";
  }

  std::string xyzHeader() const {
    std::string text = comments, names;
    for (const ExchangeField& field : fieldsOf(with_time))
      names += (names.empty() ? "" : " ") + std::string(field.name);
    return text + names + '\n';
  }
};

ExchangeWriter::ExchangeWriter(const std::filesystem::path& path, const PointFileInfo& info,
                               const Options& options) {
  const std::string extension = lowerExtension(path);
  if (extension != ".ply" && extension != ".xyz")
    throw UsageError(path.string() + ": is neither .ply nor .xyz");
  state_ = std::make_unique<State>(path, info, options);
  state_->file.write(state_->ply ? state_->plyHeader() : state_->xyzHeader());
}

ExchangeWriter::~ExchangeWriter() = default;

void ExchangeWriter::append(const PointChunk& chunk, std::size_t from, std::size_t to) {
  State& s = *state_;
  s.block.clear();
  for (std::size_t i = from; i < to; ++i) {
    if (s.ascii)
      putRow(chunk, i, s.with_time, TextRow(s.block, s.decimals));
    else
      putRow(chunk, i, s.with_time, BinaryRow(s.block));
  }
  s.file.write(s.block);
  s.count += to - from;
}

std::uint64_t ExchangeWriter::pointCount() const {
  return state_->count;
}

void ExchangeWriter::finish() {
  if (state_->ply) {
    const std::string header = state_->plyHeader();
    state_->file.writeAt(0, header.data(), header.size());
  }
  state_->file.commit();
}

}  // namespace pcl_als
