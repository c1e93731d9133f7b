// A scene or a storyboard, and what it was made from; plain types that all of the extension uses.
// In: the text of a scene file, if there is one, and keys with their texts. Out: the library's
// script.
#pragma once

#include <piblocks/instant.hpp>
#include <piblocks/script.hpp>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "cli/option_texts.hpp"
#include "cli/render_job.hpp"
#include "core/overwrite_check.hpp"

namespace piblocks::python {

/// Options of a command, and their texts.
using Options = std::map<std::string, std::string>;

/// The name of a keyword, the key of the scene file that it sets, and the texts of its value;
/// without texts the key has its default, whatever the file says.
using KeyTexts = std::tuple<std::string, std::string, std::optional<std::vector<std::string>>>;

/// Immutable, so that threads may share it.
struct Recipe {
  std::string origin;               ///< of the text, named in messages
  std::optional<std::string> text;  ///< of a scene file
  bool is_file = false;             ///< whether the origin is the path of a file
  std::vector<KeyTexts> keys;       ///< win over the text, later ones over earlier ones

  /// @throws SceneError, UsageError
  /// @param defaults  win over the text, but not over keys. @param defaults_origin  as in messages
  Script script(const std::vector<cli::SceneDefault>& defaults = {},
                const std::string& defaults_origin = {}) const;
  /// @throws SceneError if the text is no scene file.
  void fill(ScriptBuilder& builder, const std::vector<cli::SceneDefault>& defaults = {},
            const std::string& defaults_origin = {}) const;
  /// Enters the scene file, and the logos of what was made of it.
  void claim_inputs(OverwriteCheck& check, const Script& script) const;
};

struct BoundScript {
  Recipe recipe;
  Script script;
};

/// The one scene of a script.
/// @param operation  named in messages. @throws UsageError if the script is a storyboard.
const Scene& scene_of(const BoundScript& script, const char* operation);

/// @param operation  named in messages. @throws UsageError if the name is "-".
void refuse_standard_output(const std::string& output, const char* operation);

/// The memory of an array.
/// @throws std::invalid_argument unless it is writable, without gaps, and has exactly so many bytes
std::span<std::uint8_t> bytes_of(const pybind11::buffer& buffer, std::size_t size_bytes);

pybind11::bytes bytes_object(std::span<const std::uint8_t> bytes);

/// @param option  named in messages
Instant instant_of(const std::string& option, const std::string& text);

/// Hexadecimal, because Python limits the length of decimal numbers.
std::string hexadecimal(const Integer& value);

void bind_script(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_frames(pybind11::module_& module);
void bind_render(pybind11::module_& module);
void bind_golden(pybind11::module_& module);
void bind_compare(pybind11::module_& module);

}  // namespace piblocks::python
