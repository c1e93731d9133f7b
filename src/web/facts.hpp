// What a page shows in its fields and lists.
// In: a film; the scenes and names that the program has. Out: JSON.
#pragma once

#include <string>

#include "web/live.hpp"

namespace piblocks::web {

/// {"kind":"scene" or "storyboard","width":…,"height":…,"rate":[numerator,denominator],
///  "frames":…,"filmProblem":"…","keys":{"…":["…"]},"toml":"…"}, and for a scene also "hasTurn",
///  "digits" (null unless the mass ratio is that of some digits), "massRatio", "bodies" (null if
///  there are two blocks and a wall), "notes". For a storyboard "keys" has those of the whole film.
std::string facts_json(const LiveScript& live);

/// {"frame":…,"nearFrame":…,"state":"…"}: what the film shows at this place.
std::string shown_json(const LiveScript& live, const LiveScript::Place& place);

/// {"scenes":[{"name":"…","summary":"…","text":"…"},…],"themes":[…],"overlays":[…],"panels":[…]}
std::string program_json();

/// Most bodies that "bodies" has rows for; of more there is the number alone.
inline constexpr std::size_t kMaxBodyRows = 60;

}  // namespace piblocks::web
