// Lists and objects of JSON.
// In: texts that are JSON, or names and texts that are not yet. Out: JSON.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "core/text.hpp"

namespace piblocks::web {

inline std::string json_array(const std::vector<std::string>& values) {
  return fmt::format("[{}]", fmt::join(values, ","));
}

inline std::string json_texts(const std::vector<std::string>& values) {
  std::vector<std::string> quoted;
  quoted.reserve(values.size());
  for (const std::string& value : values) quoted.push_back(json_text(value));
  return json_array(quoted);
}

/// @param members  names, and values that are JSON
inline std::string json_object(const std::vector<std::pair<std::string, std::string>>& members) {
  std::string text;
  for (const auto& [name, value] : members) {
    text += fmt::format("{}{}:{}", text.empty() ? "" : ",", json_text(name), value);
  }
  return '{' + text + '}';
}

}  // namespace piblocks::web
