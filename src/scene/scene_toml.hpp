// A script as the text of a scene file.
// In: a script. Out: TOML that reads back as the same script; keys at their defaults are left out.
#pragma once

#include <piblocks/script.hpp>

#include <string>

namespace piblocks {

/// Numbers are exact, as strings: "1/3". The path of a logo is absolute.
std::string scene_toml(const Script& script);

}  // namespace piblocks
