#include "scene/toml_file.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <system_error>

namespace piblocks {
namespace {

static_assert(TOML_MAX_NESTED_VALUES == kMaxSceneNesting);

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kMaxSceneFile_bytes + 1, '\0');
  if (file) file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file.eof() && file.fail()) {
    throw SceneError(
        fmt::format("scene: cannot read '{}': {}", path, std::generic_category().message(errno)));
  }
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxSceneFile_bytes) {
    throw SceneError(fmt::format("scene: '{}' is longer than {} bytes", path, kMaxSceneFile_bytes));
  }
  return text;
}

std::optional<std::string> scalar_text(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  return std::nullopt;
}

TomlTable table_of(const toml::table& table);

/// Those of a list that has nothing but tables.
std::vector<TomlTable> tables_of(const toml::array& list) {
  std::vector<TomlTable> tables;
  for (const toml::node& element : list) {
    const toml::table* table = element.as_table();
    if (table == nullptr) return {};
    tables.push_back(table_of(*table));
  }
  return tables;
}

TomlEntry entry_of(const std::string& key, const toml::node& node) {
  constexpr const char* kExpected = "must be a number, a string, true or false, or a list of these";
  TomlEntry entry{key, {}, {}, node.source().begin.line, {}};
  if (const auto text = scalar_text(node)) {
    entry.values.push_back(*text);
  } else if (const auto* list = node.as_array()) {
    for (const toml::node& element : *list) {
      const auto element_text = scalar_text(element);
      if (!element_text) entry.problem = kExpected;
      entry.values.push_back(element_text.value_or(""));
    }
    entry.tables = tables_of(*list);
  } else {
    entry.problem = kExpected;
  }
  return entry;
}

TomlTable table_of(const toml::table& table) {
  TomlTable result{{}, table.source().begin.line};
  for (const auto& [name, node] : table) {
    const toml::table* inner = node.as_table();
    if (inner == nullptr) {
      result.entries.push_back(entry_of(std::string(name.str()), node));
      continue;
    }
    for (const auto& [key, value] : *inner) {
      result.entries.push_back(entry_of(fmt::format("{}.{}", name.str(), key.str()), value));
    }
  }
  std::ranges::stable_sort(result.entries, {}, &TomlEntry::line);
  return result;
}

}  // namespace

TomlTable read_toml(const std::string& path) {
  try {
    TomlTable root = table_of(toml::parse(read_text(path), path));
    root.line = 0;
    return root;
  } catch (const toml::parse_error& error) {
    throw SceneError(
        fmt::format("{}:{}: {}", path, error.source().begin.line, error.description()));
  }
}

}  // namespace piblocks
