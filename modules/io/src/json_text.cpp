// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/io/json_text.h>

namespace pcl_als {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

/// The keys of the objects that are open while a text is parsed.
class OpenObjects {
 public:
  explicit OpenObjects(std::string file) : file_(std::move(file)) {}

  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kDeepest)
      throw InputError(file_ + ": values are nested in more than " + std::to_string(kDeepest) +
                       " levels");
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
  static constexpr int kDeepest = 100;  ///< values are converted and deleted recursively

  std::string file_;
  std::vector<std::set<std::string>> keys_;
};

FieldValue valueOf(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return json.get<bool>();
    case Json::value_t::number_integer:
      return json.get<std::int64_t>();
    case Json::value_t::number_unsigned:
      return json.get<std::uint64_t>();
    case Json::value_t::number_float:
      return json.get<double>();
    case Json::value_t::string:
      return json.get_ref<const std::string&>();
    case Json::value_t::array: {
      FieldValue::List list;
      list.reserve(json.size());
      for (const Json& item : json) list.push_back(valueOf(item));
      return list;
    }
    case Json::value_t::object: {
      FieldValue::Object object;
      for (const auto& [key, value] : json.items()) object.emplace_back(key, valueOf(value));
      return object;
    }
    default:
      return {};
  }
}

OrderedJson jsonOf(const FieldValue& value) {
  if (const auto* list = value.as<FieldValue::List>()) {
    OrderedJson json = OrderedJson::array();
    for (const FieldValue& item : *list) json.push_back(jsonOf(item));
    return json;
  }
  if (const auto* object = value.as<FieldValue::Object>()) {
    OrderedJson json = OrderedJson::object();
    for (const auto& [key, field] : *object) json[key] = jsonOf(field);
    return json;
  }
  if (const auto* truth = value.as<bool>()) return *truth;
  if (const auto* whole = value.as<std::int64_t>()) return *whole;
  if (const auto* count = value.as<std::uint64_t>()) return *count;
  if (const auto* number = value.as<double>()) return *number;
  if (const auto* text = value.as<std::string>()) return *text;
  return nullptr;
}

}  // namespace

std::string jsonText(const FieldValue& value) {
  return jsonOf(value).dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

FieldValue parseJson(const std::string& text, const std::string& name) {
  try {
    OpenObjects open(name);
    return valueOf(Json::parse(text, [&open](int depth, Json::parse_event_t event, Json& parsed) {
      return open(depth, event, parsed);
    }));
  } catch (const nlohmann::json::exception& error) {
    const std::string what = error.what();
    // "[json.exception.parse_error.101] parse error at …": the part a user can act on.
    const std::size_t end = what.find("] ");
    throw InputError(
        name + ": is not valid JSON: " + (end == std::string::npos ? what : what.substr(end + 2)));
  }
}

}  // namespace pcl_als
