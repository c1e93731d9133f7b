// A TOML file as a flat list of keys, and lists of tables below some of them.
// In: a path, or a text. Out: "table.key" with its values as text and its line.
#pragma once

#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

struct TomlTable;

struct TomlEntry {
  std::string key;                  ///< "red.mass"
  std::vector<std::string> values;  ///< decimals as they stand in the file
  std::vector<TomlTable> tables;    ///< of a list of tables, which has no values
  std::size_t line = 0;             ///< from 1
  std::string problem;              ///< why there are no values, if there are none
};

struct TomlTable {
  std::vector<TomlEntry> entries;  ///< by line
  std::size_t line = 0;            ///< where it begins, from 1; 0 for the file itself
};

/// The text of an open file. @param name  of the file, for messages
/// @throws SceneError if it cannot be read or is longer than kMaxSceneFile_bytes.
std::string read_toml_text(std::istream& file, const std::string& name);

/// @throws SceneError if the file cannot be read, is too long, or is no TOML.
TomlTable read_toml(const std::string& path);

/// The same of a text. @param origin  named in messages instead of a path
TomlTable parse_toml(const std::string& origin, std::string_view text);

}  // namespace piblocks
