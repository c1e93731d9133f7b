// What a film is made of: a scene, or a storyboard of several; and how a file becomes one.
// In: plain values, or a scene file (TOML) and keys with their text. Out: one valid script, or
// every problem at once.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/scene.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace piblocks {

/// Lines of text in the middle of the frame; the first is the heading.
struct Card {
  std::vector<std::string> lines;  ///< 1 … kMaxCardLines, not empty
  Rational length_s = 2;           ///< of video, > 0; rounded up to whole frames
  /// What the lines become while the card is shown: each with more characters, which slide in, and
  /// after them new lines. All lines are large then. Empty, or from as many lines to kMaxCardLines.
  std::vector<std::string> becomes = {};
};

/// The share of a card's length after which its lines become others.
inline const Rational kCardChanges(2, 5);

/// How runs that are compared share the frame.
enum class Split {
  automatic,  ///< in columns if the frame is wider than high, else in rows
  columns,    ///< side by side
  rows        ///< one above the other
};

/// One scene that fills the frame, or 2 … kMaxCompared that share it. They have one clock, that of
/// the run whose last collision comes last: its scene.time and scene.pacing hold for all, and so do
/// instants such as "turn".
using Scenes = std::vector<Scene>;

/// A [[part]] of the file.
struct Segment {
  std::variant<Scenes, Card> content;
  Split split = Split::automatic;  ///< of several scenes
  /// Fade from the segment before, in seconds of video, rounded to whole frames; 0 for a cut. Both
  /// segments run meanwhile: in the first half the one before fades to the background, in the
  /// second half this one appears from it.
  Rational fade_s = 0;
  std::string origin = {};  ///< named in messages, such as "story.toml:12"
};

struct Storyboard {
  // For the whole film, whatever the scenes say.
  View view = {};  ///< size, frame rate, theme, background and colours
  Sound sound = {};
  Golden golden = {};
  std::vector<Segment> segments = {};  ///< 1 … kMaxSegments
};

/// @throws UsageError that lists the names there are.
Split parse_split(std::string_view name);
std::string exact_text(Split split);

inline constexpr std::size_t kMaxCardLines = 8;
inline constexpr std::size_t kMaxCompared = 4;
inline constexpr std::size_t kMaxSegments = 100;

/// What a film is made from.
using Script = std::variant<Scene, Storyboard>;

/// Size, frame rate, theme, background and colours of the whole film.
const View& view_of(const Script& script);
const Sound& sound_of(const Script& script);

/// All scenes of the film, in order; valid as long as the script.
std::vector<const Scene*> scenes_of(const Script& script);

/// The scene as the film shows it: with the film's size, frame rate, theme, background and colours.
Scene with_film_view(Scene scene, const View& film);

/// Everything that is wrong with it, except what depends on the length of a run; empty if nothing
/// is.
std::vector<Problem> problems_of(const Storyboard& story);

/// All that changes a frame, as exact text in a fixed order: a line for the film and one for each
/// segment. Two storyboards with equal descriptions are the same film.
std::vector<std::pair<std::string, std::string>> describe(const Storyboard& story);

/// Of a file; text that read_text() takes may be longer. It is room for about 40,000 bodies, fewer
/// than kMaxBodies.
inline constexpr std::size_t kMaxSceneFile_bytes = 1 << 20;
inline constexpr int kMaxSceneNesting = 256;  ///< of lists and tables in a scene file

/// Collects values from a file and from options, and remembers where each came from.
///
/// assets/scenes/README.md lists the keys of a scene. "digits" and "mass-ratio" set red.mass,
/// "restitution" sets "blocks.restitution" and "wall.restitution".
///
/// A file with [[part]] is a storyboard: its other keys hold for all parts. A part takes the keys
/// of a scene except those of the whole film, and also "card", "becomes", "seconds", "compare",
/// "split" and "fade".
class ScriptBuilder {
 public:
  ScriptBuilder();
  ~ScriptBuilder();
  /// With all that the other one has read and set; neither changes the other later.
  ScriptBuilder(const ScriptBuilder& other);
  ScriptBuilder& operator=(const ScriptBuilder&) = delete;

  /// Reads a scene file; called once. It overwrites values set before it, values set later win.
  /// @throws SceneError if it cannot be read or is no TOML; other problems wait for build().
  void read_file(const std::string& path);
  /// The same with the text of a scene file. @param origin  named in messages instead of a path.
  void read_text(const std::string& origin, std::string_view text);
  /// Ignores a key of the scene file, so that it keeps its default. Call this before reading. The
  /// same key in a [[part]] is read all the same.
  /// "body 2.label" is a property of the second [[body]], and "body 2" all of it. Bodies that are
  /// left out keep their numbers.
  void leave_out(const std::string& key);
  /// Removes one item from a key's list, whether the file or set() gives the list. Call this before
  /// reading.
  /// @param item  as the item of a Problem
  void leave_out(const std::string& key, const std::string& item);
  /// The same in one [[part]] and in all that it compares. An empty item stands for all of the key.
  /// @param line  of the [[part]]
  void leave_out_of_part(std::size_t line, const std::string& key, const std::string& item);
  /// Sets one key from text, as an option of the command line does. A storyboard takes keys of the
  /// whole film only, whether it is read before or after. "body 2.mass" is the mass of the second
  /// [[body]] of the file, which must have been read. The number after the last one adds a body.
  /// @param origin  named in messages, such as "--size".
  void set(const std::string& origin, const std::string& key, const std::string& text);
  /// The same with the texts of a list, such as the two of "view.x".
  void set(const std::string& origin, const std::string& key,
           const std::vector<std::string>& texts);

  /// @throws SceneError with every problem: origin, key, value and reason.
  Script build() const;
  /// As build(). @throws SceneError also if the file is a storyboard.
  Scene build_scene() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace piblocks
