// What a key that a scene file does not have was meant to be.
// In: a key as the file has it. Out: text for a message.
#pragma once

#include <string>

#include "scene/toml_file.hpp"

namespace piblocks {

/// "unknown key; did you mean 'view.size'?"
std::string about_unknown_key(const std::string& key);

/// The same for an entry, which may be a list of tables, such as [[bodi]]. Empty if the key exists.
std::string about_unknown(const TomlEntry& entry);

}  // namespace piblocks
