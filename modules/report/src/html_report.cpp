// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <sstream>

#include <sys/stat.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/field_table.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/drawing/markup.h>
#include <pcl_als/report/html_report.h>

#include "report_style.h"

namespace pcl_als {
namespace {

std::string timeText(std::time_t time) {
  std::tm broken{};
  gmtime_r(&time, &broken);
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &broken);
  return text.data();
}

std::string sizeText(double bytes) {
  if (bytes < 1e3) return numberText(bytes, 0) + " B";
  if (bytes < 1e6) return significantText(bytes / 1e3, 3) + " kB";
  if (bytes < 1e9) return significantText(bytes / 1e6, 3) + " MB";
  return significantText(bytes / 1e9, 3) + " GB";
}

std::string gradeClass(VerdictGrade grade) {
  return grade == VerdictGrade::good ? "good" : grade == VerdictGrade::bad ? "bad" : "attention";
}

/// A number, also one with its standard deviation in brackets, an interval or a percentage.
bool numeric(const std::string& cell) {
  const bool begins =
      cell.rfind("−", 0) == 0 || cell.rfind("–", 0) == 0 ||
      (!cell.empty() && std::string("+-.0123456789").find(cell[0]) != std::string::npos);
  return begins && std::none_of(cell.begin(), cell.end(), [](unsigned char c) {
           return (std::isalpha(c) != 0 && c != 'e') || c == ':' || c == '&';
         });
}

/// Columns that hold numbers only, or nothing.
std::vector<bool> numericColumns(const ReportTable& table) {
  std::vector<bool> numbers(table.columns.size(), !table.rows.empty());
  for (const auto& row : table.rows) {
    const std::size_t cells = row.size() < numbers.size() ? row.size() - 1 : row.size();
    for (std::size_t i = 0; i < cells; ++i) {
      numbers[i] = numbers[i] && (row[i].empty() || numeric(row[i]));
    }
  }
  return numbers;
}

/// With the minus sign that programs read.
std::string plainCell(std::string cell) {
  for (std::size_t at; (at = cell.find("−")) != std::string::npos;) cell.replace(at, 3, "-");
  return csvCell(cell);
}

std::string joined(const std::vector<std::string>& cells, const std::string& separator,
                   bool as_csv) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    line += (i > 0 ? separator : "") + (as_csv ? plainCell(cells[i]) : cells[i]);
  }
  return line;
}

std::string tableHtml(const ReportTable& table) {
  std::ostringstream out;
  out << "<div class=\"wide\"><table"
      << (table.name.empty() ? "" : " id=\"" + escapeHtml(table.name) + "\"") << ">";
  if (!table.caption.empty()) out << "<caption>" << escapeHtml(table.caption) << "</caption>";
  out << "<thead><tr>";
  const std::vector<bool> numbers = numericColumns(table);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    out << "<th scope=\"col\"" << (numbers[i] ? " class=\"n\">" : ">")
        << escapeHtml(table.columns[i]) << "</th>";
  }
  out << "</tr></thead>\n<tbody>";
  for (const auto& row : table.rows) {
    const auto index = static_cast<std::size_t>(&row - table.rows.data());
    const bool failed =
        std::find(table.failed.begin(), table.failed.end(), index) != table.failed.end();
    out << (failed ? "<tr class=\"failed\">" : "<tr>");
    for (std::size_t i = 0; i < row.size(); ++i) {
      // A row that ends early has its remark across the remaining columns.
      const std::size_t across = i + 1 == row.size() ? table.columns.size() - i : 1;
      out << (across > 1   ? "<td colspan=\"" + std::to_string(across) + "\">"
              : numbers[i] ? std::string("<td class=\"n\">")
                           : std::string("<td>"))
          << (row[i].empty() ? "–" : escapeHtml(row[i])) << "</td>";
    }
    out << "</tr>\n";
  }
  out << "</tbody></table></div>\n";
  return out.str();
}

/// A name of a section within the page.
std::string anchorOf(const std::string& heading) {
  std::string anchor = "section";
  for (const char c : heading) anchor += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return anchor;
}

std::string tableMarkdown(const ReportTable& table) {
  std::ostringstream out;
  if (!table.caption.empty()) out << table.caption << "\n\n";
  out << "| " << joined(table.columns, " | ", false) << " |\n|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) out << "---|";
  for (const auto& row : table.rows) out << "\n| " << joined(row, " | ", false) << " |";
  out << "\n\n";
  return out.str();
}

}  // namespace

HtmlReport::HtmlReport(std::string title, std::string tool)
    : title_(std::move(title)), tool_(std::move(tool)) {
  made_ = timeText(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now()));
}

void HtmlReport::setVerdict(VerdictGrade grade, std::string headline) {
  grade_ = grade;
  headline_ = std::move(headline);
}

void HtmlReport::addVerdict(std::string sentence) {
  verdict_.push_back(std::move(sentence));
}

void HtmlReport::addSection(std::string heading) {
  blocks_.push_back({Kind::heading, std::move(heading), {}, {}, {}});
}

void HtmlReport::addText(std::string paragraph) {
  blocks_.push_back({Kind::text, std::move(paragraph), {}, {}, {}});
}

void HtmlReport::addList(std::vector<std::string> items) {
  blocks_.push_back({Kind::list, {}, std::move(items), {}, {}});
}

void HtmlReport::addTable(ReportTable table) {
  for (const auto& row : table.rows) {
    if (!row.empty() && row.size() <= table.columns.size()) continue;
    throw UsageError("report table '" + table.caption + "': a row has " +
                     std::to_string(row.size()) + " cells, not 1 to " +
                     std::to_string(table.columns.size()));
  }
  blocks_.push_back({Kind::table, {}, {}, std::move(table), {}});
}

void HtmlReport::addPicture(const Canvas& picture, const std::string& caption) {
  blocks_.push_back({Kind::picture, caption, {}, {}, picture.svg(caption)});
}

void HtmlReport::addSetting(std::string name, std::string value) {
  settings_.push_back({std::move(name), std::move(value)});
}

void HtmlReport::addInput(const std::filesystem::path& path) {
  struct stat facts {};
  if (stat(path.c_str(), &facts) != 0) {
    inputs_.push_back({path.string(), "missing", ""});
  } else {
    inputs_.push_back(
        {path.string(), sizeText(static_cast<double>(facts.st_size)), timeText(facts.st_mtime)});
  }
}

ReportTable HtmlReport::settingsTable() const {
  return {"", "", {"setting", "value"}, settings_};
}

ReportTable HtmlReport::inputsTable() const {
  ReportTable table{"", "", {"file", "size", "last change"}, {}};
  for (const Input& input : inputs_) table.rows.push_back({input.path, input.size, input.time});
  return table;
}

std::string HtmlReport::htmlOf(const Block& block) const {
  std::ostringstream out;
  switch (block.kind) {
    case Kind::heading:
      out << "<h2 id=\"" << anchorOf(block.text) << "\">" << escapeHtml(block.text) << "</h2>\n";
      break;
    case Kind::text:
      out << "<p>" << escapeHtml(block.text) << "</p>\n";
      break;
    case Kind::table:
      out << tableHtml(block.table);
      break;
    case Kind::list:
      out << "<ul>";
      for (const std::string& item : block.items) out << "<li>" << escapeHtml(item) << "</li>\n";
      out << "</ul>\n";
      break;
    case Kind::picture:
      out << "<figure>" << block.svg << "<figcaption>" << escapeHtml(block.text)
          << "</figcaption></figure>\n";
      break;
  }
  return out.str();
}

std::string HtmlReport::contents() const {
  std::vector<std::string> headings;
  for (const Block& block : blocks_)
    if (block.kind == Kind::heading) headings.push_back(block.text);
  if (headings.size() < 3) return {};
  std::string text = "<nav aria-label=\"Contents\">";
  for (const std::string& heading : headings)
    text += "<a href=\"#" + anchorOf(heading) + "\">" + escapeHtml(heading) + "</a> ";
  return text + "</nav>\n";
}

std::string HtmlReport::appendix() const {
  std::string text;
  if (!inputs_.empty()) text += "<h2>Inputs</h2>\n" + tableHtml(inputsTable());
  if (!settings_.empty()) text += "<h2>Settings</h2>\n" + tableHtml(settingsTable());
  return text;
}

std::string HtmlReport::html() const {
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      << "<title>" << escapeHtml(title_) << "</title>\n<link rel=\"icon\" href=\"data:,\">\n"
      << "<style>" << detail::kReportStyle << Canvas::themeStyle()
      << "</style>\n</head>\n<body>\n<main>\n<h1>" << escapeHtml(title_)
      << "</h1>\n<section id=\"verdict\" class=\"" << gradeClass(grade_)
      << "\">\n<p class=\"headline\">" << escapeHtml(headline_) << "</p>\n";
  if (!verdict_.empty()) {
    out << "<ul>";
    for (const std::string& sentence : verdict_) out << "<li>" << escapeHtml(sentence) << "</li>\n";
    out << "</ul>\n";
  }
  out << "</section>\n" << contents();
  for (const Block& block : blocks_) out << htmlOf(block);
  out << appendix() << "<footer>Made by " << escapeHtml(tool_) << ", " << made_
      << "</footer>\n</main>\n<script>" << detail::kReportScript << "</script>\n</body>\n</html>\n";
  return out.str();
}

std::string HtmlReport::markdown() const {
  std::ostringstream out;
  out << "# " << title_ << "\n\n**" << headline_ << "**\n\n";
  for (const std::string& sentence : verdict_) out << "- " << sentence << '\n';
  out << '\n';
  for (const Block& block : blocks_) {
    if (block.kind == Kind::heading) out << "## " << block.text << "\n\n";
    if (block.kind == Kind::text) out << block.text << "\n\n";
    if (block.kind == Kind::table) out << tableMarkdown(block.table);
    if (block.kind != Kind::list) continue;
    for (const std::string& item : block.items) out << "- " << item << '\n';
    out << '\n';
  }
  if (!inputs_.empty()) out << "## Inputs\n\n" << tableMarkdown(inputsTable());
  if (!settings_.empty()) out << "## Settings\n\n" << tableMarkdown(settingsTable());
  out << "Made by " << tool_ << ", " << made_ << '\n';
  return out.str();
}

void HtmlReport::write(const std::filesystem::path& folder) const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const Block& block : blocks_) {
    if (block.kind != Kind::table || block.table.name.empty()) continue;
    std::string csv = joined(block.table.columns, ",", true) + "\n";
    for (const auto& row : block.table.rows)
      csv +=
          joined(row, ",", true) + std::string(block.table.columns.size() - row.size(), ',') + "\n";
    writeFile(folder / (block.table.name + ".csv"), csv);
  }
  writeFile(folder / "report.md", markdown());
  writeFile(folder / "report.html", html());
}

}  // namespace pcl_als
