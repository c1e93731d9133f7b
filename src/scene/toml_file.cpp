#include "scene/toml_file.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

// Releases of toml++ differ: 256 up to 3.4, 128 after it. One that was compiled keeps its own.
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): the library reads it
#define TOML_MAX_NESTED_VALUES 256
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "core/descriptor.hpp"
#include "core/text.hpp"

namespace piblocks {
namespace {

static_assert(TOML_MAX_NESTED_VALUES == kMaxSceneNesting);

/// The text of a file by line and column, which toml++ counts from 1, columns in code points.
class SourceText {
 public:
  explicit SourceText(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      lines_.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  /// A value that stands on one line.
  std::string_view of(const toml::source_region& region) const {
    const std::string_view line = lines_.at(region.begin.line - 1);
    const std::size_t begin = offset(line, region.begin.column);
    return line.substr(begin, offset(line, region.end.column) - begin);
  }

 private:
  static std::size_t offset(std::string_view line, toml::source_index column) {
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    std::size_t at = 0;
    for (toml::source_index i = 1; i < column && at < line.size(); ++i) {
      do ++at;
      while (at < line.size() && continues(line[at]));
    }
    return at;
  }

  std::vector<std::string_view> lines_;
};

[[noreturn]] void fail(const std::string& path, std::int64_t line, std::string reason) {
  throw SceneError(
      Problem{.reason = std::move(reason), .origin = fmt::format("{}:{}", path, line)});
}

/// @throws SceneError that names the first line that is not UTF-8.
void check_encoding(const std::string& path, std::string_view text) {
  std::int64_t line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (!is_utf8(text.substr(begin, end - begin))) {
      fail(path, line, "is not valid UTF-8; save the file in that encoding");
    }
    begin = end + 1;
  }
}

/// More than any key of a scene has. toml++ makes a nested table for each part and destroys them by
/// recursion.
constexpr int kMostKeyParts = 16;

/// The end of a string that begins here; a string without a closing quote ends with its line or
/// with the text.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string triple(3, quote);
  const bool is_long = text.substr(begin).starts_with(triple);
  for (std::size_t i = begin + (is_long ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (is_long && text.substr(i).starts_with(triple)) {
      return i + 3;
    } else if (!is_long && (text[i] == quote || text[i] == '\n')) {
      return text[i] == quote ? i + 1 : i;
    }
  }
  return text.size();
}

/// @throws SceneError for a key of too many parts, before toml++ makes tables of them.
void check_keys(const std::string& path, std::string_view text) {
  std::int64_t line = 1;
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    std::size_t end = i + 1;
    if (c == '"' || c == '\'') {
      end = end_of_string(text, i);
    } else if (c == '#') {
      end = std::min(text.find('\n', i), text.size());
    } else if (c == '.') {
      if (++dots >= kMostKeyParts) {
        fail(path, line, fmt::format("a key has more than {} parts", kMostKeyParts));
      }
    } else if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) {
      dots = 0;
    }
    line += std::count(text.begin() + std::ptrdiff_t(i), text.begin() + std::ptrdiff_t(end), '\n');
    i = end;
  }
}

/// Makes our tables from those of toml++.
class Reader {
 public:
  explicit Reader(const SourceText& source) : source_(source) {}

  TomlTable table_of(const toml::table& table) const {
    TomlTable result{{}, table.source().begin.line};
    add_entries(table, "", result.entries);
    std::ranges::stable_sort(result.entries, {}, &TomlEntry::line);
    return result;
  }

 private:
  /// Keys of tables in the table begin with the names of these. @param before  such as "view."
  void add_entries(const toml::table& table, const std::string& before,
                   std::vector<TomlEntry>& entries) const {
    for (const auto& [name, node] : table) {
      const std::string key = fmt::format("{}{}", before, name.str());
      if (const toml::table* inner = node.as_table()) {
        add_entries(*inner, key + '.', entries);
      } else {
        entries.push_back(entry_of(key, node));
      }
    }
  }

  std::optional<std::string> scalar_text(const toml::node& node) const {
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    if (!node.is_floating_point()) return std::nullopt;
    // From the file: toml++ keeps only the nearest double.
    std::string text(source_.of(node.source()));
    std::erase(text, '_');
    return text;
  }

  /// The tables of a list that has only tables; otherwise none.
  std::vector<TomlTable> tables_of(const toml::array& list) const {
    std::vector<TomlTable> tables;
    for (const toml::node& element : list) {
      const toml::table* table = element.as_table();
      if (table == nullptr) return {};
      tables.push_back(table_of(*table));
    }
    return tables;
  }

  TomlEntry entry_of(const std::string& key, const toml::node& node) const {
    constexpr const char* kExpectedValue =
        "must be a number, a string, true or false, or a list of these";
    TomlEntry entry{key, {}, {}, node.source().begin.line, {}};
    if (const auto text = scalar_text(node)) {
      entry.values.push_back(*text);
    } else if (const auto* list = node.as_array()) {
      for (const toml::node& element : *list) {
        const auto element_text = scalar_text(element);
        if (!element_text) entry.problem = kExpectedValue;
        entry.values.push_back(element_text.value_or(""));
      }
      entry.tables = tables_of(*list);
    } else {
      entry.problem = kExpectedValue;
    }
    return entry;
  }

  const SourceText& source_;
};

}  // namespace

std::string read_toml_text(std::istream& file, const std::string& name) {
  std::string text(kMaxSceneFile_bytes + 1, '\0');
  if (file) file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file.eof() && file.fail()) {
    throw SceneError(fmt::format("scene: cannot read '{}': {}", name, error_text(errno)));
  }
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxSceneFile_bytes) {
    throw SceneError(
        fmt::format("scene: '{}' is longer than {} bytes, the most that a scene file may have; "
                    "leave out bodies, parts or comments",
                    name, kMaxSceneFile_bytes));
  }
  return text;
}

TomlTable read_toml(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return parse_toml(path, read_toml_text(file, path));
}

TomlTable parse_toml(const std::string& origin, std::string_view text) {
  check_encoding(origin, text);
  check_keys(origin, text);
  const SourceText source(text);
  try {
    TomlTable root = Reader(source).table_of(toml::parse(text, origin));
    root.line = 0;
    return root;
  } catch (const toml::parse_error& error) {
    fail(origin, error.source().begin.line, std::string(error.description()));
  }
}

}  // namespace piblocks
