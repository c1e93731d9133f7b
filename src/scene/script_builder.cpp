#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/storyboard.hpp>

#include <algorithm>
#include <sstream>

#include "scene/scene_keys.hpp"
#include "scene/toml_file.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kPart = "part";
constexpr std::string_view kCompare = "compare";

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
    for (std::string line; std::getline(text, line);) lines.push_back(checked_line(line));
  }
  if (lines.empty() || lines.size() > kMaxCardLines) {
    throw UsageError(fmt::format("must be from 1 to {} lines of text", kMaxCardLines));
  }
  if (std::ranges::any_of(lines, &std::string::empty)) {
    throw UsageError("must not have an empty line");
  }
  return lines;
}

Rational seconds_of(const Values& values) {
  Rational seconds = parse_rational(single(values));
  if (seconds <= 0) throw UsageError("must be greater than 0");
  return seconds;
}

Rational fade_of(const Values& values) {
  Rational fade = parse_rational(single(values));
  if (fade < 0) throw UsageError("must not be less than 0");
  return fade;
}

}  // namespace

struct ScriptBuilder::PartBuilder {
  std::string origin;
  std::optional<Card> card = {};
  std::vector<SceneBuilder> runs = {};
  Rational fade_s = 0;
};

ScriptBuilder::ScriptBuilder() = default;
ScriptBuilder::~ScriptBuilder() = default;

void ScriptBuilder::add_problem(std::size_t line, const std::string& text) {
  problems_.push_back(fmt::format("{}:{}: {}", path_, line, text));
}

void ScriptBuilder::read_file(const std::string& path) {
  path_ = path;
  TomlTable root = read_toml(path);
  std::vector<TomlTable> parts;
  for (TomlEntry& entry : root.entries) {
    if (entry.key == kPart && !entry.tables.empty()) {
      parts = std::move(entry.tables);
    } else if (entry.key == kPart || entry.key.starts_with("part.")) {
      add_problem(entry.line, "part: is written [[part]], once for each part");
    }
  }
  std::erase_if(root.entries, [](const TomlEntry& entry) {
    return entry.key == kPart || entry.key.starts_with("part.");
  });
  film_.read(path, root);
  if (parts.size() > kMaxStoryParts) {
    add_problem(parts[kMaxStoryParts].line,
                fmt::format("part: there must be at most {} of them", kMaxStoryParts));
    parts.resize(kMaxStoryParts);
  }
  for (const TomlTable& part : parts) read_part(part);
}

/// Takes the entry's value if there is one, and notes what is wrong with it.
template <typename Target, typename Parse>
void take(const TomlEntry* entry, Target& target, const Parse& parse,
          std::vector<std::string>& problems, const std::string& path) {
  if (entry == nullptr) return;
  std::string problem = entry->problem;
  try {
    if (problem.empty()) target = parse(entry->values);
  } catch (const UsageError& error) {
    problem = error.what();
  }
  if (problem.empty()) return;
  problems.push_back(fmt::format("{}:{}: {}: {}", path, entry->line, entry->key, problem));
}

void ScriptBuilder::read_part(const TomlTable& table) {
  PartBuilder part{fmt::format("{}:{}", path_, table.line)};
  const TomlEntry* const fade = find(table, "fade");
  take(fade, part.fade_s, fade_of, problems_, path_);
  if (part.fade_s > 0 && parts_.empty()) {
    add_problem(fade->line, "fade: no part is before the first; leave it out");
  }
  if (find(table, "card") != nullptr) {
    read_card(table, part);
  } else {
    read_runs(table, part);
  }
  parts_.push_back(std::move(part));
}

void ScriptBuilder::read_card(const TomlTable& table, PartBuilder& part) {
  Card& card = part.card.emplace();
  take(find(table, "card"), card.lines, lines_of, problems_, path_);
  take(find(table, "seconds"), card.length_s, seconds_of, problems_, path_);
  for (const TomlEntry& entry : table.entries) {
    if (entry.key == "card" || entry.key == "seconds" || entry.key == "fade") continue;
    add_problem(entry.line,
                fmt::format("{}: a card has nothing but 'card', 'seconds' and 'fade'", entry.key));
  }
}

/// The scene that the keys above the parts describe, whose problems are told once.
SceneBuilder ScriptBuilder::next_run(const std::string& origin) const {
  SceneBuilder run = film_;
  run.problems_.clear();
  run.place_ = origin;
  return run;
}

void ScriptBuilder::read_runs(const TomlTable& table, PartBuilder& part) {
  TomlTable keys{{}, table.line};
  for (const TomlEntry& entry : table.entries) {
    if (entry.key == "fade" || entry.key == kCompare) continue;
    if (entry.key == "seconds") {
      add_problem(entry.line, "seconds: is the length of a card; a run has time.duration");
    } else if (is_film_key(entry.key)) {
      add_problem(entry.line,
                  fmt::format("{}: holds for the whole film; put it above the parts", entry.key));
    } else {
      keys.entries.push_back(entry);
    }
  }
  SceneBuilder run = next_run(part.origin);
  run.read(path_, keys);
  part.runs.push_back(std::move(run));
  if (const TomlEntry* compare = find(table, kCompare)) read_compared(*compare, part);
}

/// What the part says holds for each of them.
void ScriptBuilder::read_compared(const TomlEntry& compare, PartBuilder& part) {
  if (compare.tables.size() < 2 || compare.tables.size() > kMaxCompared) {
    add_problem(compare.line, fmt::format("compare: must be a list of 2 to {} tables, as "
                                          "[{{digits = 1}}, {{digits = 2}}]",
                                          kMaxCompared));
    return;
  }
  const SceneBuilder common = std::move(part.runs.front());
  part.runs.clear();
  for (const TomlTable& table : compare.tables) {
    TomlTable keys{{}, table.line};
    for (const TomlEntry& entry : table.entries) {
      if (is_film_key(entry.key)) {
        add_problem(entry.line,
                    fmt::format("{}: holds for the whole film; put it above the parts", entry.key));
      } else if (entry.key.starts_with("time.")) {
        add_problem(entry.line, fmt::format("{}: what is compared has one clock; say it for the "
                                            "part",
                                            entry.key));
      } else {
        keys.entries.push_back(entry);
      }
    }
    SceneBuilder& run = part.runs.emplace_back(common);
    run.read(path_, keys);
  }
}

void ScriptBuilder::set(const std::string& origin, const std::string& key,
                        const std::string& text) {
  set_.push_back({origin, key});
  film_.set(origin, key, text);
  for (PartBuilder& part : parts_) {
    for (SceneBuilder& run : part.runs) run.set(origin, key, text);
  }
}

void ScriptBuilder::set_mass_ratio(const std::string& origin, const Rational& ratio) {
  set_.push_back({origin, "mass-ratio"});
  film_.set_mass_ratio(origin, ratio);
}

/// Keys of one run that were set from outside of the storyboard, before it was read or after.
std::vector<std::string> ScriptBuilder::misplaced_keys() const {
  std::vector<std::string> problems;
  for (const auto& [origin, key] : set_) {
    if (is_film_key(key)) continue;
    problems.push_back(fmt::format(
        "{}: '{}' is a storyboard; put {} into it, for all parts or for one. Options can set size, "
        "frame rate, theme, background and sound of the whole film",
        origin, path_, key));
  }
  return problems;
}

Script ScriptBuilder::build() const {
  if (parts_.empty() && problems_.empty()) return film_.build();
  std::vector<std::string> problems = problems_;
  if (!parts_.empty()) {
    const std::vector<std::string> misplaced = misplaced_keys();
    problems.insert(problems.end(), misplaced.begin(), misplaced.end());
  }
  // What is wrong for every part is told once.
  const auto add = [&](const std::vector<std::string>& more) {
    for (const std::string& problem : more) {
      if (std::ranges::count(problems, problem) == 0) problems.push_back(problem);
    }
  };
  add(film_.problems_);
  Storyboard story{film_.scene_.view, film_.scene_.sound, film_.scene_.golden, {}};
  for (const Problem& problem : problems_of(film_.scene_)) {
    if (is_film_key(problem.key)) add({film_.described(problem)});
  }
  for (const PartBuilder& part : parts_) {
    StoryPart& built = story.parts.emplace_back();
    built.origin = part.origin;
    built.fade_s = part.fade_s;
    if (part.card) {
      built.content = *part.card;
      continue;
    }
    Runs runs;
    for (const SceneBuilder& run : part.runs) {
      try {
        runs.push_back(run.build());
      } catch (const SceneError& error) {
        add(error.problems());
      }
    }
    built.content = std::move(runs);
  }
  if (!problems.empty()) throw SceneError(std::move(problems));
  return story;
}

}  // namespace piblocks
