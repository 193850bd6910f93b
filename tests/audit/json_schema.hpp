// json_schema.hpp
//
// For tests: as much of JSON Schema (draft 2020-12) as docs/audit.schema.json uses, and not more: a keyword that is not
// understood here is a breach itself.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

namespace cleancolor {

class JsonSchema {
 public:
  explicit JsonSchema(nlohmann::json root) : root_(std::move(root)) {}

  /// What the value breaks, one line each; empty: it is valid.
  std::vector<std::string> breaches(const nlohmann::json& value) const {
    std::vector<std::string> found;
    check(value, root_, "", found);
    return found;
  }

  const nlohmann::json& root() const { return root_; }

 private:
  using Json = nlohmann::json;

  static bool has_type(const Json& value, const std::string& type) {
    if (type == "integer") return value.is_number() && std::floor(value.get<double>()) == value.get<double>();
    if (type == "number") return value.is_number();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    return type == "null" && value.is_null();
  }

  void check(const Json& value, const Json& schema, const std::string& at, std::vector<std::string>& found) const {
    for (const auto& [keyword, rule] : schema.items())
      if (!holds(value, schema, keyword, rule, at, found))
        found.push_back(fmt::format("{}: {} of {}", at, keyword, value.dump().substr(0, 80)));
  }

  /// One keyword; what lies deeper adds its own breaches.
  bool holds(const Json& value, const Json& schema, const std::string& keyword, const Json& rule, const std::string& at,
             std::vector<std::string>& found) const {
    if (keyword == "description" || keyword == "title" || keyword == "$schema" || keyword == "$defs") return true;
    if (keyword == "$ref") {
      check(value, root_.at(Json::json_pointer(rule.get<std::string>().substr(1))), at, found);
      return true;
    }
    if (keyword == "type") {
      const std::vector<std::string> types =
          rule.is_array() ? rule.get<std::vector<std::string>>() : std::vector{rule.get<std::string>()};
      return std::ranges::any_of(types, [&](const std::string& t) { return has_type(value, t); });
    }
    if (keyword == "const") return value == rule;
    if (keyword == "enum") return std::ranges::find(rule, value) != rule.end();
    if (keyword == "minimum") return !value.is_number() || value.get<double>() >= rule.get<double>();
    if (keyword == "pattern") return std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
    if (keyword == "minItems") return value.size() >= rule.get<std::size_t>();
    if (keyword == "maxItems") return value.size() <= rule.get<std::size_t>();
    if (keyword == "items") {
      for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
        check(value[i], rule, fmt::format("{}/{}", at, i), found);
      return true;
    }
    if (keyword == "required")
      return std::ranges::all_of(rule, [&](const Json& name) { return value.contains(name.get<std::string>()); });
    if (keyword == "properties") {
      for (const auto& [name, sub] : rule.items())
        if (value.contains(name)) check(value[name], sub, at + "/" + name, found);
      return true;
    }
    if (keyword == "additionalProperties") {
      for (const auto& [name, member] : value.items()) {
        if (schema.at("properties").contains(name)) continue;
        if (rule == false) return false;
        check(member, rule, at + "/" + name, found);
      }
      return true;
    }
    found.push_back("a keyword that this validator does not know: " + keyword);
    return true;
  }

  Json root_;
};

}  // namespace cleancolor
