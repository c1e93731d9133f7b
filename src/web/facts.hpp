// What a page shows in its fields and lists; exact numbers as people write them.
// In: a film; the scenes and names that the program has. Out: JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "web/live.hpp"

namespace piblocks::web {

/// "2.5" for 5/2; a fraction that is no decimal of at most 20 places stays one.
std::string decimal_text(const Rational& value);

/// The same for every fraction in a text: "turn-0.3" for "turn-3/10".
std::string with_decimals(std::string_view text);

/// {"mass":"1","position":["2"],"velocity":["0"],"size":"1","color":"…","label":"…"}: as its table
/// in a scene file, with decimals.
std::string body_json(const Body& body, const BodyStyle& style, int dimensions);

/// {"kind":"scene" or "storyboard","width":…,"height":…,"rate":[numerator,denominator],
///  "frames":…,"filmProblem":"…","keys":{"…":["…"]},"toml":"…","ranges":RANGES}, and for a scene
///  also "hasTurn", "bodies" (null if there are two blocks and a wall), "notes". Width and height
///  are those of the picture. "keys" has numbers as decimals where they are decimals; those of two
///  blocks and a wall also "digits", "mass-ratio" and "wall.mass", and those of a storyboard hold
///  for the whole film.
std::string facts_json(const LiveScript& live, std::string_view ranges = "{}");

/// {"frame":…,"nearFrame":…,"state":"…","stage":…}: what the film shows at this place. For blue and
/// red on a line "stage" is {"scale":…,"blocks":[{"key":"blue",
/// "rect":[x,y,width,height],"arrow":[x,y,x,y] or null},{"key":"red",…}],"arrowScale":…,
/// "longestArrow":…} in pixels, else null. An arrow of a small velocity is this times "arrowScale"
/// long, and one of any length the velocity is length / (1 - length / longestArrow) / arrowScale;
/// both are 0 without arrows.
/// @param picture  of this place
std::string shown_json(const LiveScript& live, const LiveScript::Place& place,
                       const DrawList& picture);

Rational mass_ratio_of(const Scene& scene);
/// The number of digits that this mass ratio counts; nothing if it is not an even power of the
/// base.
std::optional<int> digits_of(const Rational& ratio, int base);

/// {"scenes":[{"name":"…","summary":"…","text":"…"},…],"themes":[…],"overlays":[…],"panels":[…],
///  "alike":[["digits","mass-ratio","red.mass"],…]}; keys that are alike set the same value.
std::string program_json();

/// Most bodies that "bodies" has rows for; of more there is the number alone.
inline constexpr std::size_t kMaxBodyRows = 60;

}  // namespace piblocks::web
