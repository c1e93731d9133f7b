#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

#include "scene/scene_draft.hpp"

namespace piblocks {
namespace {

const TomlEntry* find(const TomlTable& table, std::string_view key) {
  const auto found = std::ranges::find(table.entries, key, &TomlEntry::key);
  return found == table.entries.end() ? nullptr : &*found;
}

/// A list, or one text of several lines.
std::vector<std::string> lines_of(const Values& values) {
  std::vector<std::string> lines;
  for (const std::string& value : values) {
    if (value.empty()) lines.emplace_back();
    std::istringstream text(value);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
  }
  return lines;
}

Rational number_of(const Values& values) { return parse_rational(single(values)); }
Split split_of(const Values& values) { return parse_split(single(values)); }

/// Makes the segments of a storyboard from the tables of its file.
class StoryReader {
 public:
  /// @param path  of the file, named in messages.
  /// @param film  the values for all segments.
  StoryReader(std::string path, const SceneDraft& film, ProblemLines& problems)
      : path_(std::move(path)), film_(film), problems_(problems) {
    const Scene scene = film.make(problems, true);
    story_ = {scene.view, scene.sound, scene.golden, {}};
  }

  /// Adds the segment that a [[part]] describes.
  void read(const TomlTable& table) {
    Origins origins;
    Segment segment = segment_of(table, origins);
    for (const Problem& problem : problems_of(segment, story_.segments.empty())) {
      const auto origin = origins.find(problem.key);
      const bool has_origin = origin != origins.end();
      // Text that could not be read has been reported already.
      if (!has_origin && find(table, problem.key) != nullptr) continue;
      problems_.add(has_origin ? origin->second : segment.origin, problem);
    }
    story_.segments.push_back(std::move(segment));
  }

  const Storyboard& story() const { return story_; }

 private:
  /// Origins of the keys that are not a scene's, by key.
  using Origins = std::map<std::string, std::string>;

  Segment segment_of(const TomlTable& table, Origins& origins) {
    Segment segment;
    segment.origin = origin_of(table.line);
    take(table, "fade", segment.fade_s, number_of, origins);
    if (find(table, "card") != nullptr) {
      segment.content = card_of(table, origins);
    } else {
      take(table, "split", segment.split, split_of, origins);
      segment.content = scenes_of(table);
    }
    return segment;
  }

  Card card_of(const TomlTable& table, Origins& origins) {
    Card card;
    take(table, "card", card.lines, lines_of, origins);
    take(table, "becomes", card.becomes, lines_of, origins);
    take(table, "seconds", card.length_s, number_of, origins);
    for (const TomlEntry& entry : table.entries) {
      constexpr std::array<std::string_view, 4> kKeys = {"card", "becomes", "seconds", "fade"};
      if (std::ranges::count(kKeys, entry.key) > 0) continue;
      add_problem(entry, "a card has nothing but 'card', 'becomes', 'seconds' and 'fade'");
    }
    return card;
  }

  /// The keys of one scene. @param problem_of  says why a key may not be here, or nullptr.
  TomlTable checked(const TomlTable& table, const auto& problem_of) {
    TomlTable keys{{}, table.line};
    for (const TomlEntry& entry : table.entries) {
      const char* const problem = is_film_key(entry.key)
                                      ? "holds for the whole film; put it above the parts"
                                      : problem_of(entry.key);
      if (problem != nullptr) {
        add_problem(entry, problem);
      } else {
        keys.entries.push_back(entry);
      }
    }
    return keys;
  }

  Scenes scenes_of(const TomlTable& table) {
    TomlTable keys = checked(table, [](const std::string& key) {
      return key == "seconds"   ? "is the length of a card; a run has time.duration"
             : key == "becomes" ? "is what the lines of a card become"
                                : nullptr;
    });
    std::erase_if(keys.entries, [](const TomlEntry& entry) {
      return entry.key == "compare" || entry.key == "split" || entry.key == "fade";
    });
    SceneDraft common = film_.next(origin_of(table.line));
    common.read(path_, std::move(keys));
    std::vector<SceneDraft> drafts = {common};
    if (const TomlEntry* compare = find(table, "compare")) drafts = compared(*compare, common);
    Scenes scenes;
    for (const SceneDraft& draft : drafts) scenes.push_back(draft.make(problems_));
    return scenes;
  }

  /// The values of the part hold for each of the compared runs.
  std::vector<SceneDraft> compared(const TomlEntry& compare, const SceneDraft& common) {
    if (compare.tables.size() < 2 || compare.tables.size() > kMaxCompared) {
      add_problem(compare, fmt::format("must be a list of 2 to {} tables, as [{{digits = 1}}, "
                                       "{{digits = 2}}]",
                                       kMaxCompared));
      return {common};
    }
    std::vector<SceneDraft> drafts;
    for (const TomlTable& table : compare.tables) {
      drafts.emplace_back(common).read(
          path_, checked(table, [](const std::string& key) {
            return key.starts_with("time.")
                       ? "compared runs share one clock; set this key for the part"
                       : nullptr;
          }));
    }
    return drafts;
  }

  /// Takes the value of the key if the table has it, and notes its origin or its problem.
  void take(const TomlTable& table, const char* key, auto& target, const auto& parse,
            Origins& origins) {
    const TomlEntry* const entry = find(table, key);
    if (entry == nullptr) return;
    if (!entry->problem.empty()) return add_problem(*entry, entry->problem);
    try {
      target = parse(entry->values);
      origins.emplace(key, origin_of(entry->line));
    } catch (const UsageError& error) {
      problems_.add(path_, entry->line, problem_of_text(key, entry->values, error));
    }
  }

  void add_problem(const TomlEntry& entry, const std::string& text) {
    problems_.add(path_, entry.line, {entry.key, ": " + text});
  }

  std::string origin_of(std::size_t line) const { return fmt::format("{}:{}", path_, line); }

  std::string path_;
  const SceneDraft& film_;
  Storyboard story_;
  ProblemLines& problems_;
};

/// Takes an item out of a list. @returns whether nothing is left of it
bool take_out(const std::string& key, const std::string& item, Values& values) {
  values = list_of(values);
  const auto is_it = [&](const std::string& text) { return normalized_item(key, text) == item; };
  if (std::erase_if(values, is_it) == 0 || !values.empty()) return false;
  // Without its key the theme would choose overlays.
  if (key == "show.overlays") values = {"none"};
  return key != "show.overlays";
}

}  // namespace

struct ScriptBuilder::Impl {
  struct LeftOutOfPart {
    std::size_t line;
    std::string key;
    std::string item;
  };

  SceneDraft film{"scene"};           // in a storyboard the values for all parts
  std::string path;                   // of the file, or what stands for it in messages
  std::vector<std::string> left_out;  // keys of the file
  std::vector<std::pair<std::string, std::string>> left_out_items;  // keys and what of their lists
  std::vector<LeftOutOfPart> left_out_of_parts;
  std::vector<TomlTable> parts;
  ProblemLines problems;                                      // of entries that are no parts
  std::vector<std::pair<std::string, std::string>> set_keys;  // origin and key, by set()

  void read(const std::string& origin, TomlTable root);
  bool leave_out(TomlEntry& entry) const;
  bool leave_out_items(const std::string& key, Values& values) const;
  void leave_out_of(std::size_t line, TomlTable& table) const;
};

ScriptBuilder::ScriptBuilder() : impl_(std::make_unique<Impl>()) {}
ScriptBuilder::ScriptBuilder(const ScriptBuilder& other)
    : impl_(std::make_unique<Impl>(*other.impl_)) {}
ScriptBuilder::~ScriptBuilder() = default;

void ScriptBuilder::read_file(const std::string& path) { impl_->read(path, read_toml(path)); }

void ScriptBuilder::read_text(const std::string& origin, std::string_view text) {
  impl_->read(origin, parse_toml(origin, text));
}

/// Whether to leave out an entry of the file. Of one that sets two keys, the other one may be kept.
bool ScriptBuilder::Impl::leave_out(TomlEntry& entry) const {
  const auto is_out = [&](std::string_view key) {
    return std::ranges::any_of(left_out,
                               [&](const std::string& out) { return set_same_value(out, key); });
  };
  if (entry.key != "restitution") return is_out(entry.key);
  const bool keeps_blocks = !is_out("blocks.restitution");
  const bool keeps_wall = !is_out("wall.restitution");
  if (keeps_blocks != keeps_wall)
    entry.key = keeps_blocks ? "blocks.restitution" : "wall.restitution";
  return !keeps_blocks && !keeps_wall;
}

/// Takes items out of the texts of a list. @returns whether nothing is left of it
bool ScriptBuilder::Impl::leave_out_items(const std::string& key, Values& values) const {
  return std::ranges::any_of(left_out_items, [&](const auto& one) {
    return one.first == key && take_out(key, one.second, values);
  });
}

/// @param table  the part on this line, or what it compares
void ScriptBuilder::Impl::leave_out_of(std::size_t line, TomlTable& table) const {
  std::erase_if(table.entries, [&](TomlEntry& entry) {
    for (TomlTable& run : entry.tables) leave_out_of(line, run);
    return std::ranges::any_of(left_out_of_parts, [&](const LeftOutOfPart& out) {
      return out.line == line && out.key == entry.key &&
             (out.item.empty() || take_out(out.key, out.item, entry.values));
    });
  });
}

void ScriptBuilder::Impl::read(const std::string& origin, TomlTable root) {
  path = origin;
  TomlTable common{{}, root.line};
  for (TomlEntry& entry : root.entries) {
    if (leave_out(entry) || leave_out_items(entry.key, entry.values)) continue;
    const bool is_part = entry.key == "part";
    if (is_part && !entry.tables.empty()) {
      parts = std::move(entry.tables);
      for (TomlTable& part : parts) leave_out_of(part.line, part);
    } else if (is_part || entry.key.starts_with("part.")) {
      problems.add(path, entry.line, {"part", ": is written [[part]], once for each part"});
    } else {
      common.entries.push_back(std::move(entry));
    }
  }
  film.read(path, std::move(common));
  if (parts.size() > kMaxSegments) {
    problems.add(path, parts[kMaxSegments].line,
                 {"part", fmt::format(": there must be at most {} of them", kMaxSegments)});
    parts.resize(kMaxSegments);
  }
}

void ScriptBuilder::leave_out(const std::string& key) {
  if (number_in(key, "body ") > 0) return impl_->film.leave_out_body_key(key);
  impl_->left_out.push_back(key);
}

void ScriptBuilder::leave_out(const std::string& key, const std::string& item) {
  impl_->left_out_items.emplace_back(key, item);
}

void ScriptBuilder::leave_out_of_part(std::size_t line, const std::string& key,
                                      const std::string& item) {
  impl_->left_out_of_parts.push_back({line, key, item});
}

void ScriptBuilder::set(const std::string& origin, const std::string& key,
                        const std::string& text) {
  set(origin, key, std::vector{text});
}

void ScriptBuilder::set(const std::string& origin, const std::string& key,
                        const std::vector<std::string>& texts) {
  impl_->set_keys.emplace_back(origin, key);
  Values values = texts;
  if (impl_->leave_out_items(key, values)) values = {""};
  impl_->film.set(origin, key, values);
}

Script ScriptBuilder::build() const {
  if (impl_->parts.empty() && impl_->problems.empty()) return build_scene();
  ProblemLines problems = impl_->problems;
  for (const auto& [origin, key] : impl_->set_keys) {
    if (impl_->parts.empty() || is_film_key(key)) continue;
    problems.add(origin, {.reason = fmt::format(
                              "'{}' is a storyboard; put {} into it, for all parts or for one. "
                              "Options can set size, frame rate, theme, background and sound of "
                              "the whole film",
                              impl_->path, key)});
  }
  StoryReader reader(impl_->path, impl_->film, problems);
  for (const TomlTable& part : impl_->parts) reader.read(part);
  problems.require_none();
  return reader.story();
}

Scene ScriptBuilder::build_scene() const {
  ProblemLines problems = impl_->problems;
  if (!impl_->parts.empty()) {
    problems.add(impl_->path, {.reason = "is a storyboard; a scene has no [[part]]"});
  }
  Scene scene = impl_->film.make(problems);
  problems.require_none();
  return scene;
}

}  // namespace piblocks
