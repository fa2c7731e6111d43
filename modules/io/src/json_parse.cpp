// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "json_parse.h"

#include <set>
#include <vector>

#include <pcl_als/common/errors.h>

namespace pcl_als::detail {
namespace {

using Json = nlohmann::json;

/// The keys of the objects that are open while a text is parsed.
class OpenObjects {
 public:
  explicit OpenObjects(std::string file) : file_(std::move(file)) {}

  bool operator()(int /*depth*/, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys_.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_.pop_back();
    if (event != Json::parse_event_t::key) return true;
    const std::string key = parsed.get<std::string>();
    if (!keys_.back().insert(key).second) {
      throw InputError(file_ + ": the key '" + printable(key, kLongestQuotation) +
                       "' stands twice in one object");
    }
    return true;
  }

 private:
  std::string file_;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

Json parseJson(const std::string& text, const std::string& name) {
  try {
    OpenObjects open(name);
    return Json::parse(text, [&open](int depth, Json::parse_event_t event, Json& parsed) {
      return open(depth, event, parsed);
    });
  } catch (const nlohmann::json::exception& error) {
    const std::string what = error.what();
    // "[json.exception.parse_error.101] parse error at …": the part a user can act on.
    const std::size_t end = what.find("] ");
    throw InputError(
        name + ": is not valid JSON: " + (end == std::string::npos ? what : what.substr(end + 2)));
  }
}

}  // namespace pcl_als::detail
