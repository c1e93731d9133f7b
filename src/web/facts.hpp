// What a page shows in its fields and lists.
// In: a film; the scenes and names that the program has. Out: JSON.
#pragma once

#include <string>

#include "web/live.hpp"

namespace piblocks::web {

/// {"kind":"scene" or "storyboard","width":…,"height":…,"rate":[numerator,denominator],
///  "frames":…,"filmProblem":"…","sound":…,"keys":{"…":["…"]},"toml":"…"}, and of a scene
///  "collisions", "firstCollision", "hasTurn", "mayGoOn", "digits" (null unless the masses are
///  those of digits), "massRatio", "bodies" (null of two blocks and a wall), "notes". Of a
///  storyboard "keys" has those of the whole film.
std::string facts_json(const Live& live);

/// {"frame":…,"nearFrame":…,"state":"…"}: what of the film is shown.
std::string place_json(const Live& live, const Live::Place& place);

/// {"version":"…","scenes":[{"name":"…","summary":"…","text":"…"},…],"themes":[…],"overlays":[…],
///  "panels":[…]}
std::string program_json();

/// Most bodies that "bodies" has rows for; of more there is the number alone.
inline constexpr std::size_t kMaxBodyRows = 60;

}  // namespace piblocks::web
