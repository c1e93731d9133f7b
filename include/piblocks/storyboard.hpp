// Several runs in one film: title cards, scenes, comparisons, and how one follows the other.
// In: a scene file with parts, and options. Out: one valid value, or every problem at once.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/scene.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace piblocks {

/// Lines of text in the middle of the frame; the first is the heading.
struct Card {
  std::vector<std::string> lines;  ///< 1 … kMaxCardLines, not empty
  Rational length_s = 2;           ///< of video, > 0; rounded up to whole frames
};

/// One run that fills the frame, or 2 … kMaxCompared side by side, or one above the other in a
/// frame that is not wider than high. These have one clock, that of the run whose last collision
/// comes last: its scene.time and scene.pacing hold for all, and so do moments such as "turn".
using Runs = std::vector<Scene>;

struct StoryPart {
  std::variant<Runs, Card> content;
  /// Cross-fade from the part before, in seconds of video, rounded to whole frames, in which both
  /// parts are seen; 0 for a cut.
  Rational fade_s = 0;
  std::string origin = {};  ///< named in messages, such as "story.toml:12"
};

struct Storyboard {
  // Of the whole film, whatever the scenes say.
  View view = {};  ///< size, frame rate, theme and background
  Sound sound = {};
  Golden golden = {};
  std::vector<StoryPart> parts = {};  ///< 1 … kMaxStoryParts
};

inline constexpr std::size_t kMaxCardLines = 8;
inline constexpr std::size_t kMaxCompared = 4;
inline constexpr std::size_t kMaxStoryParts = 100;

/// What a film is made from.
using Script = std::variant<Scene, Storyboard>;

/// Size, frame rate, theme and background of the whole film.
const View& view_of(const Script& script);

/// Of the whole film.
const Sound& sound_of(const Script& script);

/// The scene as the film shows it: with the film's size, frame rate, theme and background.
Scene with_film_view(Scene scene, const View& film);

/// Everything that is wrong with it, but for what takes the length of a run to know; empty if
/// nothing is.
std::vector<std::string> problems_of(const Storyboard& story);

/// All that changes a frame, as exact text in a fixed order: a line for the film and one for each
/// part. Two storyboards with equal descriptions are the same film.
std::vector<std::pair<std::string, std::string>> describe(const Storyboard& story);

struct TomlEntry;

/// Collects a script from a scene file and from options, as SceneBuilder does a scene. A file with
/// [[part]] is a storyboard: its other keys hold for all parts, and a part takes all keys of a
/// scene but those of the whole film, and beside them "card" and "seconds", "compare", "fade".
class ScriptBuilder {
 public:
  ScriptBuilder();
  ~ScriptBuilder();
  ScriptBuilder(const ScriptBuilder&) = delete;
  ScriptBuilder& operator=(const ScriptBuilder&) = delete;

  /// As SceneBuilder::read_file(); called once.
  void read_file(const std::string& path);
  /// As SceneBuilder::set(). A storyboard takes keys of the whole film only,
  /// whether it is read before or after.
  void set(const std::string& origin, const std::string& key, const std::string& text);
  /// As SceneBuilder::set_mass_ratio(). A storyboard takes none.
  void set_mass_ratio(const std::string& origin, const Rational& ratio);
  /// @throws SceneError with every problem: origin, key, value and reason.
  Script build() const;

 private:
  struct PartBuilder;

  void read_part(const TomlTable& table);
  void read_card(const TomlTable& table, PartBuilder& part);
  void read_runs(const TomlTable& table, PartBuilder& part);
  void read_compared(const TomlEntry& compare, PartBuilder& part);
  SceneBuilder next_run(const std::string& origin) const;
  std::vector<std::string> misplaced_keys() const;
  void add_problem(std::size_t line, const std::string& text);

  SceneBuilder film_;
  std::string path_;
  std::vector<PartBuilder> parts_;
  std::vector<std::string> problems_;
  struct SetKey {
    std::string origin;
    std::string key;
  };
  std::vector<SetKey> set_;  // by set(), in order
};

}  // namespace piblocks
