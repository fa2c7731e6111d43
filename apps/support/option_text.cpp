// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "option_text.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als::app {
namespace {

constexpr std::size_t kWidth = 100, kOptionColumn = 2, kTextColumn = 30;

std::string joinedBy(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

std::string boundText(const Option& option, double bound) {
  if (option.role == Role::whole && bound >= 1e19) return "18446744073709551615";
  if (option.role == Role::whole) return std::to_string(static_cast<std::uint64_t>(bound));
  return shortText(bound);
}

/// What stands for the value: "N", "FILE...", "las|laz".
std::string valueName(const Option& option) {
  constexpr std::size_t kLongest = 18;
  const std::string many = option.is_list ? "..." : "";
  switch (option.role) {
    case Role::flag:
      return "";
    case Role::number:
      return "NUMBER";
    case Role::whole:
      return "N";
    case Role::choice: {
      const std::string words = joinedBy(option.words, "|");
      return words.size() <= kLongest ? words : "WORD";
    }
    case Role::input:
    case Role::output:
      return "FILE" + many;
    case Role::folder:
      return "FOLDER";
    case Role::text:
      break;
  }
  return "TEXT" + many;
}

/// What follows from the role, added to the text of an option: "(m, 0.01 to 1000; default: 1)".
std::string consequences(const Option& option) {
  std::vector<std::string> parts;
  if (option.role == Role::number || option.role == Role::whole) {
    const bool bounded = option.range.high < 2147483647.0;
    std::string range = boundText(option, option.range.low);
    range += bounded ? " to " + boundText(option, option.range.high) : " or more";
    parts.push_back((option.range.unit.empty() ? "" : option.range.unit + ", ") + range);
  }
  if (option.role == Role::choice && valueName(option) == "WORD")
    parts.push_back(joined(option.words));
  if (option.role == Role::output) parts.push_back(joined(option.words));
  if (option.is_needed) parts.emplace_back("needed");
  if (option.preset && !option.preset->empty()) parts.push_back("default: " + *option.preset);
  return parts.empty() ? "" : " (" + joinedBy(parts, "; ") + ")";
}

/// Appends words from \a column on, in lines of kWidth.
void wrap(const std::string& text, std::size_t column, std::string& out) {
  std::istringstream words(text);
  std::size_t at = column;
  for (std::string word; words >> word;) {
    if (at > column && at + 1 + word.size() > kWidth) {
      out += '\n' + std::string(column, ' ');
      at = column;
    }
    if (at > column) out += ' ', ++at;
    out += word, at += word.size();
  }
  out += '\n';
}

/// A name for scripts and a title for readers, in the order of Group.
struct GroupNames {
  const char *name, *title;
};
constexpr GroupNames kGroups[] = {{"inputs", "Inputs"},
                                  {"strips", "Strips"},
                                  {"estimation", "What is estimated"},
                                  {"priors", "Priors and assumed errors"},
                                  {"output", "Output"},
                                  {"others", "Further options"}};

std::string helpOf(const Option& option) {
  std::string text = std::string(kOptionColumn, ' ') + "--" + option.name;
  if (option.role != Role::flag) text += ' ' + valueName(option);
  if (text.size() + 2 <= kTextColumn)
    text.resize(kTextColumn, ' ');
  else
    text += '\n' + std::string(kTextColumn, ' ');
  wrap(option.help + consequences(option), kTextColumn, text);
  return text;
}

const char* nameOf(Role role) {
  constexpr const char* kNames[] = {"flag",   "text",  "number", "whole",
                                    "choice", "input", "output", "folder"};
  return kNames[static_cast<std::size_t>(role)];
}

}  // namespace

std::string rangeText(const Option& option) {
  return boundText(option, option.range.low) + " to " + boundText(option, option.range.high) +
         (option.range.unit.empty() ? "" : " " + option.range.unit);
}

std::string optionHelp(const std::deque<Option>& options) {
  std::string text;
  for (std::size_t part = 0; part < std::size(kGroups); ++part) {
    std::string needed, others;
    for (const Option& option : options)
      if (option.group == static_cast<Group>(part))
        (option.is_needed ? needed : others) += helpOf(option);
    if (needed.empty() && others.empty()) continue;
    text += '\n' + std::string(kGroups[part].title) + ":\n" + needed + others;
  }
  return text;
}

std::string optionTable(const CommandLine& line) {
  std::ostringstream out;
  out << "name\trole\tneed\tdefault\tunit\tleast\tgreatest\twords\tgroup\n";
  for (const Arguments& form : line.forms()) {
    const std::string need = form.with.empty() ? "" : "with -" + form.with;
    out << "IN\tinput\t" << need << "\t\t\t" << form.least << '\t' << form.most << "\t\tinputs\n";
    if (!form.out.empty())
      out << "OUT\toutput\t" << need << "\t\t\t1\t1\t" << joinedBy(form.out, ",") << "\toutput\n";
  }
  for (const Option& option : line.options()) {
    const bool number = option.role == Role::number || option.role == Role::whole;
    out << option.name << '\t' << nameOf(option.role) << (option.is_list ? "s" : "") << '\t'
        << (option.is_needed ? "needed" : "") << '\t' << option.preset.value_or("") << '\t'
        << option.range.unit << '\t' << (number ? boundText(option, option.range.low) : "") << '\t'
        << (number ? boundText(option, option.range.high) : "") << '\t';
    std::vector<std::string> words = option.words;
    if (option.files) {
      const auto files = option.files(line);
      if (files) words.insert(words.end(), files->begin(), files->end());
    }
    out << joinedBy(words, ",") << '\t' << kGroups[static_cast<std::size_t>(option.group)].name
        << '\n';
  }
  return out.str();
}

}  // namespace pcl_als::app
