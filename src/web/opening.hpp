// A scene with what the page sets, without what its picture cannot show.
// In: a text, settings, places. Out: a film that is open, and its picture; or what is wrong.
#pragma once

#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "web/live.hpp"

namespace piblocks::web {

/// What the picture does without.
struct LeftOut {
  std::string key;
  std::string item = {};    ///< of the key's list; empty if all of the key is left out
  std::string reason = {};  ///< in words for it alone: "needs elastic collisions"
  std::size_t part = 0;     ///< line of the [[part]] that has the key; 0 for none
};

struct Request {
  std::string text;  ///< of a scene file
  /// Lines KEY=TEXT, in which the texts of a list are separated by tabs; or KEY, which gives a key
  /// its default, whatever text and lines before say. The last is what has just been changed.
  std::string settings = {};
  std::string places = {};  ///< lines as read_place(); without any, there is no picture
  std::string screen = {};  ///< "1080x1920": size of the picture, if the scene fits into it
};

/// What is shown.
struct Picture {
  LiveScript::Place place;
  DrawList list;
};

struct OpenedScript {
  std::unique_ptr<ScriptBuilder> builder = {};
  std::unique_ptr<LiveScript> live = {};
  std::optional<Picture> picture = {};  ///< at the first of the places that the scene has, or else
                                        ///< its start
  std::string place_problem = {};       ///< what is wrong with the first place
  std::vector<LeftOut> left_out = {};
};

/// Leaves out what the scene names and cannot show: overlays, diagrams, the loupe, titles, and
/// instants that its run has not; but not the key that has just been changed. If the run has no end
/// then either, the scene goes from time 0 to 10, and time.to is said to be left out.
/// @throws what commands throw.
OpenedScript open_script(const Request& request);

/// "frame 12" is a frame of the film, counted from 0; "instant turn-0.3" is any instant.
LiveScript::Place read_place(const LiveScript& live, std::string_view text);

/// Whether it may be left out because of this problem, not knowing what has been changed.
bool can_be_left_out(const Problem& problem);

/// Its reason in words for something that has been left out or cannot be added.
std::string reason_alone(const Problem& problem);

/// facts_json() with the ranges of its sliders.
std::string facts_of(const OpenedScript& opening);

/// {"facts":FACTS,"picture":PICTURE,"placeProblem":"…",
///  "leftOut":[{"key":"…","item":"…","reason":"…"},…]}
std::string opened_json(const OpenedScript& opening, std::string_view facts,
                        std::string_view picture);

/// {"problems":[{"origin":"…","key":"…","reason":"…"},…]}
std::string problems_json(const std::exception& error);

}  // namespace piblocks::web
