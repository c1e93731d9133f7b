// Several runs in one film: title cards, scenes, comparisons, and how one follows the other.
// In: plain values, filled in by hand or by script_builder.hpp. Out: everything that is wrong with
// them, and their exact text.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/scene.hpp>

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

}  // namespace piblocks
