// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/io/plan_io.h>

namespace pcl_als {
namespace {

/// The words of a text file, with the line they stand in.
class Words {
 public:
  Words(std::string name, std::string_view rest) : name_(std::move(name)), rest_(rest) {}

  /// The next word; empty at the end.
  std::string_view next() {
    std::size_t from = 0;
    while (from < rest_.size() && isBlank(rest_[from])) line_ += rest_[from++] == '\n' ? 1 : 0;
    std::size_t to = from;
    while (to < rest_.size() && !isBlank(rest_[to])) ++to;
    const std::string_view word = rest_.substr(from, to - from);
    rest_.remove_prefix(to);
    return word;
  }
  std::string_view peek() const { return Words(*this).next(); }
  double number(std::string_view what) {
    const std::string_view word = next();
    if (word.empty()) refuse("ends before " + std::string(what));
    const auto value = valueIn<double>(word);
    if (!value || !std::isfinite(*value)) {
      refuse("'" + printable(word, kLongestQuotation) + "' is not a finite number (" +
             std::string(what) + ")");
    }
    return *value;
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(name_ + ": line " + std::to_string(line_) + ": " + what);
  }
  std::size_t left() const { return rest_.size(); }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  std::string name_;
  std::string_view rest_;
  std::size_t line_ = 1;
};

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

using Header = std::map<std::string, double>;

Header readHeader(Words& words) {
  Header header;
  for (std::string key = lowered(words.peek()); !key.empty() && key[0] >= 'a' && key[0] <= 'z';
       key = lowered(words.peek())) {
    if (key == "nan" || key == "inf") break;  // a value
    words.next();
    if (header.count(key) != 0)
      words.refuse("'" + printable(key, kLongestQuotation) + "' appears twice");
    header[key] = words.number(key);
  }
  return header;
}

double need(const Words& words, const Header& header, const char* key) {
  const auto found = header.find(key);
  if (found == header.end()) {
    words.refuse("the header has no '" + std::string(key) + "': not an ESRI ASCII grid");
  }
  return found->second;
}

std::size_t countOf(const Words& words, const Header& header, const char* key) {
  constexpr double kMaximumHeight = 1e6;
  const double value = need(words, header, key);
  if (value >= 2.0 && value <= kMaximumHeight && value == std::floor(value)) {
    return static_cast<std::size_t>(value);
  }
  words.refuse("'" + std::string(key) + "' must be a whole number from 2 to 1000000");
}

/// Centre of the first cell along an axis, from its lower corner or its centre.
double firstOf(const Words& words, const Header& header, const std::string& axis, double cell) {
  const auto centre = header.find(axis + "llcenter");
  if (centre != header.end()) return centre->second;
  return need(words, header, (axis + "llcorner").c_str()) + 0.5 * cell;
}

}  // namespace

ElevationGrid ElevationGrid::read(const std::filesystem::path& path) {
  const std::string content = readWholeFile(path, kGridLimits);
  Words words(path.string(), content);
  if (words.peek().empty()) throw InputError(path.string() + ": is empty");
  const Header header = readHeader(words);
  ElevationGrid grid;
  grid.columns_ = countOf(words, header, "ncols");
  grid.rows_ = countOf(words, header, "nrows");
  grid.cell_ = need(words, header, "cellsize");
  if (grid.cell_ <= 0.0) words.refuse("'cellsize' must be more than 0");
  grid.first_ = {firstOf(words, header, "x", grid.cell_), firstOf(words, header, "y", grid.cell_)};
  const auto nodata = header.find("nodata_value");
  const std::size_t cells = grid.columns_ * grid.rows_;
  if (cells > words.left() / 2 + 1) {  // a digit and a blank each
    words.refuse("the header declares " + std::to_string(cells) +
                 " values, the file cannot hold "
                 "them");
  }
  grid.values_.assign(cells, std::numeric_limits<double>::quiet_NaN());
  std::size_t known = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    const double value =
        words.number("value " + std::to_string(i + 1) + " of " + std::to_string(cells));
    if (nodata != header.end() && value == nodata->second) continue;
    grid.values_[(grid.rows_ - 1 - i / grid.columns_) * grid.columns_ + i % grid.columns_] = value;
    grid.mean_ += value;
    ++known;
  }
  if (!words.peek().empty()) words.refuse("has more values than the header declares");
  if (known == 0) throw InputError(path.string() + ": no cell has a value");
  grid.mean_ /= static_cast<double>(known);
  return grid;
}

Eigen::AlignedBox2d ElevationGrid::extent() const {
  const Eigen::Vector2d cells(static_cast<double>(columns_ - 1), static_cast<double>(rows_ - 1));
  return {first_, first_ + cell_ * cells};
}

std::optional<double> ElevationGrid::at(const Eigen::Vector2d& place,
                                        Eigen::Vector2d& gradient) const {
  const Eigen::Vector2d at = (place - first_) / cell_;
  if (!(at.x() >= 0.0) || !(at.y() >= 0.0) || at.x() >= static_cast<double>(columns_ - 1) ||
      at.y() >= static_cast<double>(rows_ - 1)) {
    return std::nullopt;
  }
  const auto column = static_cast<std::size_t>(at.x()), row = static_cast<std::size_t>(at.y());
  const double u = at.x() - static_cast<double>(column), v = at.y() - static_cast<double>(row);
  const double sw = value(column, row), se = value(column + 1, row);
  const double nw = value(column, row + 1), ne = value(column + 1, row + 1);
  gradient = {((1.0 - v) * (se - sw) + v * (ne - nw)) / cell_,
              ((1.0 - u) * (nw - sw) + u * (ne - se)) / cell_};
  const double z = (1.0 - v) * ((1.0 - u) * sw + u * se) + v * ((1.0 - u) * nw + u * ne);
  if (!std::isfinite(z)) return std::nullopt;
  return z;
}

}  // namespace pcl_als
