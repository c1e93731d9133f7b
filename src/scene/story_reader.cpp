#include "scene/story_reader.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include "scene/rules.hpp"
#include "scene/scene_keys.hpp"

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

}  // namespace

StoryReader::StoryReader(std::string path, const SceneDraft& film)
    : path_(std::move(path)), film_(film) {
  const Scene scene = film.scene();
  story_ = {scene.view, scene.sound, scene.golden, {}};
}

void StoryReader::read(const TomlTable& table) {
  Origins origins;
  Segment segment = segment_of(table, origins);
  for (const Problem& problem : problems_of(segment, story_.segments.empty())) {
    // Text that could not be read has been reported already.
    const auto origin = origins.find(problem.key);
    const bool is_reported = origin == origins.end() && find(table, problem.key) != nullptr;
    if (is_reported) continue;
    problems_.push_back(fmt::format("{}: {} {}",
                                    origin == origins.end() ? segment.origin : origin->second,
                                    problem.key, problem.reason));
  }
  story_.segments.push_back(std::move(segment));
}

Segment StoryReader::segment_of(const TomlTable& table, Origins& origins) {
  Segment segment;
  segment.origin = fmt::format("{}:{}", path_, table.line);
  take(table, "fade", segment.fade_s, number_of, origins);
  if (find(table, "card") != nullptr) {
    segment.content = card_of(table, origins);
  } else {
    segment.content = runs_of(table);
  }
  return segment;
}

Card StoryReader::card_of(const TomlTable& table, Origins& origins) {
  Card card;
  take(table, "card", card.lines, lines_of, origins);
  take(table, "seconds", card.length_s, number_of, origins);
  for (const TomlEntry& entry : table.entries) {
    if (entry.key == "card" || entry.key == "seconds" || entry.key == "fade") continue;
    add_problem(entry, "a card has nothing but 'card', 'seconds' and 'fade'");
  }
  return card;
}

template <typename Rule>
TomlTable StoryReader::checked(const TomlTable& table, const Rule& problem_of) {
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

Runs StoryReader::runs_of(const TomlTable& table) {
  TomlTable keys = checked(table, [](const std::string& key) {
    return key == "seconds" ? "is the length of a card; a run has time.duration" : nullptr;
  });
  std::erase_if(keys.entries, [](const TomlEntry& entry) {
    return entry.key == "compare" || entry.key == "fade";
  });
  SceneDraft common = film_.next(fmt::format("{}:{}", path_, table.line));
  common.read(path_, keys);
  std::vector<SceneDraft> drafts = {common};
  if (const TomlEntry* compare = find(table, "compare")) drafts = compared(*compare, common);
  Runs runs;
  for (const SceneDraft& draft : drafts) {
    for (std::string& problem : draft.problems()) problems_.push_back(std::move(problem));
    runs.push_back(draft.scene());
  }
  return runs;
}

/// The values of the part hold for each of the compared runs.
std::vector<SceneDraft> StoryReader::compared(const TomlEntry& compare, const SceneDraft& common) {
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
          return key.starts_with("time.") ? "what is compared has one clock; say it for the part"
                                          : nullptr;
        }));
  }
  return drafts;
}

/// Takes the value of the key if the table has it, and notes its origin or its problem.
template <typename Target, typename Parse>
void StoryReader::take(const TomlTable& table, const char* key, Target& target, const Parse& parse,
                       Origins& origins) {
  const TomlEntry* const entry = find(table, key);
  if (entry == nullptr) return;
  if (!entry->problem.empty()) return add_problem(*entry, entry->problem);
  try {
    target = parse(entry->values);
    origins.emplace(key, origin_of(*entry));
  } catch (const UsageError& error) {
    problems_.push_back(fmt::format("{}: {} = {}: {}", origin_of(*entry), key,
                                    joined(entry->values), error.what()));
  }
}

void StoryReader::add_problem(const TomlEntry& entry, const std::string& text) {
  problems_.push_back(fmt::format("{}: {}: {}", origin_of(entry), entry.key, text));
}

std::string StoryReader::origin_of(const TomlEntry& entry) const {
  return fmt::format("{}:{}", path_, entry.line);
}

}  // namespace piblocks
