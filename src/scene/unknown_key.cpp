#include "scene/unknown_key.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/nearest_name.hpp"
#include "scene/scene_keys.hpp"

namespace piblocks {
namespace {

const std::vector<std::string> kListsOfTables = {"body", "wall", "part"};
const std::vector<std::string> kKeysOfParts = {"card", "becomes", "seconds",
                                               "fade", "compare", "split"};

/// The keys of a scene outside of its lists of tables.
std::vector<std::string> all_keys() {
  std::vector<std::string> names = {"digits",    "mass-ratio",     "restitution",
                                    "wall.mass", "wall.velocity",  "box.x",
                                    "box.y",     "box.x-velocity", "box.y-velocity"};
  for (const SceneKey& key : scene_keys()) names.emplace_back(key.name);
  return names;
}

std::string_view last_part(std::string_view key) { return key.substr(key.rfind('.') + 1); }
std::string first_part(const std::string& key) { return key.substr(0, key.find('.')); }

bool is_table(std::string_view name) {
  return std::ranges::any_of(
      all_keys(), [&](const std::string& key) { return key.starts_with(std::string(name) + '.'); });
}

/// Prefers a key in a table to one that differs in a few letters: 'theme' means 'view.theme'.
std::string advice(const std::string& key) {
  std::vector<std::string> names = all_keys();
  std::vector<std::string> same = names;
  std::erase_if(same, [&](const std::string& name) { return last_part(name) != last_part(key); });
  if (std::string near = did_you_mean(key, same); !near.empty()) return near;
  if (!same.empty()) return fmt::format("; did you mean '{}'?", fmt::join(same, "' or '"));
  names.insert(names.end(), kKeysOfParts.begin(), kKeysOfParts.end());
  return did_you_mean(key, names);
}

}  // namespace

std::string about_unknown_key(const std::string& key) {
  const std::string table = first_part(key);
  if (std::ranges::count(kKeysOfParts, key) > 0) return "unknown key; it belongs into a [[part]]";
  const bool is_of_walls = key == "wall.point" || key == "wall.normal";
  const std::string list =
      is_of_walls || !is_table(table) ? nearest_name(table, kListsOfTables) : "";
  if (!list.empty()) return fmt::format("unknown key; write [[{0}]], once for each {0}", list);
  if (is_table(key)) return fmt::format("unknown key; a table is written [{}]", key);
  return "unknown key" + advice(key);
}

std::string about_unknown(const TomlEntry& entry) {
  if (std::ranges::count(all_keys(), entry.key) > 0) return {};
  if (entry.tables.empty()) return about_unknown_key(entry.key);
  if (is_table(entry.key)) return fmt::format("is one table, written [{}]", entry.key);
  const std::string near = nearest_name(entry.key, kListsOfTables);
  if (!near.empty()) return fmt::format("unknown list of tables; did you mean '[[{}]]'?", near);
  const std::string known = did_you_mean(entry.key, kKeysOfParts);
  return "unknown list of tables" +
         (known.empty() ? "; there are [[body]], [[wall]] and [[part]]" : known);
}

}  // namespace piblocks
