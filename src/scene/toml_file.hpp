// A TOML file as a flat list of keys.
// In: a path. Out: "table.key" with its values as text and its line.
#pragma once

#include <string>
#include <vector>

namespace piblocks {

struct TomlEntry {
  std::string key;                  ///< "red.mass"
  std::vector<std::string> values;  ///< numbers as their shortest decimal text
  std::size_t line = 0;             ///< from 1
  std::string problem;              ///< why there are no values, if so
};

/// @throws SceneError if the file cannot be read, is too long, or is no TOML.
std::vector<TomlEntry> read_toml(const std::string& path);

}  // namespace piblocks
