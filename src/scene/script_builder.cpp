#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

#include "scene/scene_draft.hpp"
#include "scene/story_reader.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kPart = "part";

}  // namespace

struct ScriptBuilder::State {
  struct SetKey {
    std::string origin;
    std::string key;
  };
  SceneDraft film{"scene"};  // in a storyboard the values for all parts
  std::string path;
  std::vector<TomlTable> parts;
  std::vector<std::string> problems;  // of entries that are no parts
  std::vector<SetKey> set_keys;       // by set(), in order

  void add_problem(std::size_t line, const std::string& text) {
    problems.push_back(fmt::format("{}:{}: {}", path, line, text));
  }

  /// Keys of a single run that set() got, though the file is a storyboard.
  std::vector<std::string> misplaced_keys() const {
    std::vector<std::string> misplaced;
    for (const auto& [origin, key] : set_keys) {
      if (is_film_key(key)) continue;
      misplaced.push_back(fmt::format(
          "{}: '{}' is a storyboard; put {} into it, for all parts or for one. Options can set "
          "size, frame rate, theme, background and sound of the whole film",
          origin, path, key));
    }
    return misplaced;
  }
};

ScriptBuilder::ScriptBuilder() : state_(std::make_unique<State>()) {}
ScriptBuilder::~ScriptBuilder() = default;

void ScriptBuilder::read_file(const std::string& path) {
  state_->path = path;
  TomlTable root = read_toml(path);
  for (TomlEntry& entry : root.entries) {
    if (entry.key == kPart && !entry.tables.empty()) {
      state_->parts = std::move(entry.tables);
    } else if (entry.key == kPart || entry.key.starts_with("part.")) {
      state_->add_problem(entry.line, "part: is written [[part]], once for each part");
    }
  }
  std::erase_if(root.entries, [](const TomlEntry& entry) {
    return entry.key == kPart || entry.key.starts_with("part.");
  });
  state_->film.read(path, root);
  std::vector<TomlTable>& parts = state_->parts;
  if (parts.size() > kMaxSegments) {
    state_->add_problem(parts[kMaxSegments].line,
                        fmt::format("part: there must be at most {} of them", kMaxSegments));
    parts.resize(kMaxSegments);
  }
}

void ScriptBuilder::set(const std::string& origin, const std::string& key,
                        const std::string& text) {
  state_->set_keys.push_back({origin, key});
  state_->film.set(origin, key, {text});
}

Script ScriptBuilder::build() const {
  if (state_->parts.empty() && state_->problems.empty()) return build_scene();
  std::vector<std::string> problems = state_->problems;
  const auto add = [&](const std::vector<std::string>& more) {
    // A problem of every part is reported once.
    for (const std::string& problem : more) {
      if (std::ranges::count(problems, problem) == 0) problems.push_back(problem);
    }
  };
  if (!state_->parts.empty()) add(state_->misplaced_keys());
  add(state_->film.problems(true));
  StoryReader reader(state_->path, state_->film);
  for (const TomlTable& part : state_->parts) reader.read(part);
  add(reader.problems());
  if (!problems.empty()) throw SceneError(std::move(problems));
  return reader.story();
}

Scene ScriptBuilder::build_scene() const {
  std::vector<std::string> problems = state_->problems;
  if (!state_->parts.empty()) {
    problems.push_back(fmt::format("'{}' is a storyboard; a scene has no [[part]]", state_->path));
  }
  for (std::string& problem : state_->film.problems()) problems.push_back(std::move(problem));
  if (!problems.empty()) throw SceneError(std::move(problems));
  return state_->film.scene();
}

}  // namespace piblocks
