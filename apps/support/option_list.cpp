// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "option_list.h"

#include <algorithm>
#include <set>

#include <pcl_als/common/file_extension.h>

namespace pcl_als::app {

std::vector<std::string> spreadLists(int argc, const char* const* argv,
                                     const std::vector<std::string>& lists) {
  static const std::set<std::string> kPoints = {".las", ".laz", ".pcd"};
  std::vector<std::string> spread;
  std::string list;  // the option whose values may follow
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t name = argument.find_first_not_of('-');
    if (argument.size() > 1 && argument.front() == '-') {
      const bool known =
          name != std::string::npos && i + 1 < argc &&
          std::find(lists.begin(), lists.end(), argument.substr(name)) != lists.end();
      spread.push_back(argument);
      list = known ? argument : std::string();
      if (known) spread.emplace_back(argv[++i]);
      continue;
    }
    const bool value = !list.empty() && kPoints.count(lowerExtension(argument)) == 0;
    if (value) spread.push_back(list);
    if (!value) list.clear();
    spread.push_back(argument);
  }
  return spread;
}

}  // namespace pcl_als::app
