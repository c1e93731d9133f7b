#include "python/extension/script.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>
#include <pybind11/stl.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include "cli/script_facts.hpp"
#include "core/nearest_name.hpp"
#include "draw/look.hpp"
#include "python/extension/without_gil.hpp"
#include "scene/run_log.hpp"
#include "scene/scene_keys.hpp"
#include "scene/shipped_scenes.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

/// Keywords of one call of which only one may be given, as the command line has it for options.
void refuse_several(const std::vector<KeyTexts>& keys, const std::vector<std::string_view>& names,
                    const char* what) {
  std::vector<std::string> given;
  for (const auto& [keyword, key, texts] : keys) {
    if (texts && std::ranges::count(names, key) > 0) given.push_back(keyword);
  }
  if (given.size() < 2) return;
  throw UsageError(
      fmt::format("{} and {} both set {}; give one of them", given[0], given[1], what));
}

BoundScript make(std::string origin, std::optional<std::string> text, bool is_file,
                 std::vector<KeyTexts> keys) {
  const WithoutGil released;
  Recipe recipe{std::move(origin), std::move(text), is_file, std::move(keys)};
  Script script = recipe.script();
  return {std::move(recipe), std::move(script)};
}

void check_keys(const std::vector<KeyTexts>& keys) {
  refuse_several(keys, {"digits", "mass-ratio", "red.mass"}, "the mass of red");
  refuse_several(keys, {"restitution", "blocks.restitution"}, "the restitution of the blocks");
  refuse_several(keys, {"restitution", "wall.restitution"}, "the restitution of the wall");
  refuse_several(keys, {"time.speed", "time.duration"}, "the speed");
}

/// Texts as bytes, because a title or a path may be no UTF-8.
std::vector<std::pair<py::bytes, py::bytes>> description(const BoundScript& bound) {
  const auto texts = std::visit([](const auto& any) { return describe(any); }, bound.script);
  return {texts.begin(), texts.end()};
}

/// All keys of a scene file outside of its parts.
std::vector<std::string> key_names() {
  std::vector<std::string> names = {"digits", "mass-ratio", "restitution"};
  for (const SceneKey& key : scene_keys()) names.emplace_back(key.name);
  return names;
}

std::string count_of(const BoundScript& bound) {
  const WithoutGil released;
  const Scene& scene = scene_of(bound, "count");
  if (two_blocks_of(scene.system)) return hexadecimal(count_collisions(scene.system));
  const std::unique_ptr<Log> log = log_of(scene);
  const Integer count = log->last();
  require_certain(scene, *log, log->horizon());
  return hexadecimal(count);
}

/// Whether contacts at once or infinitely many collisions are in what is shown of a run; nothing of
/// one that has no end.
std::vector<std::string> notes_of_run(const Scene& scene) {
  std::vector<std::string> notes;
  const auto add = [&](const std::optional<Collapse>& collapse) {
    if (collapse) notes.push_back(endless_note(scene.system, *collapse));
  };
  if (const auto pair = two_blocks_of(scene.system)) {
    add(collapse_of(*pair));
    return notes;
  }
  const std::unique_ptr<Log> log = log_of(scene);
  const std::optional<Rational> until = end_of(scene);
  if (log->never_ends() && !until) return notes;
  add(log->collapse(until));
  auto note = tie_note(*log, until ? log->count_at(*until) : log->last());
  if (note) notes.push_back(*std::move(note));
  return notes;
}

std::vector<std::string> notes_of(const BoundScript& bound) {
  const WithoutGil released;
  std::vector<std::string> notes = convention_notes(bound.script);
  if (const auto* const scene = std::get_if<Scene>(&bound.script)) {
    std::ranges::move(notes_of_run(*scene), std::back_inserter(notes));
  }
  std::ranges::move(contrast_notes(bound.script), std::back_inserter(notes));
  return notes;
}

py::tuple size_of(const BoundScript& bound) {
  const View& view = view_of(bound.script);
  return py::make_tuple(view.width_px, view.height_px);
}

py::tuple rate_of(const BoundScript& bound) {
  const Rational& rate = view_of(bound.script).frame_rate;
  return py::make_tuple(rate.get_num().get_si(), rate.get_den().get_si());
}

}  // namespace

void Recipe::fill(ScriptBuilder& builder, const std::vector<cli::SceneDefault>& defaults,
                  const std::string& defaults_origin) const {
  for (const auto& [keyword, key, texts] : keys) {
    if (!texts) builder.leave_out(key);
  }
  if (text) builder.read_text(origin, *text);
  for (const auto& [key, value] : defaults) builder.set(defaults_origin, key, value);
  for (const auto& [keyword, key, texts] : keys) {
    if (texts) builder.set(keyword, key, *texts);
  }
}

Script Recipe::script(const std::vector<cli::SceneDefault>& defaults,
                      const std::string& defaults_origin) const {
  ScriptBuilder builder;
  fill(builder, defaults, defaults_origin);
  return builder.build();
}

void Recipe::claim_inputs(OverwriteCheck& check, const Script& script) const {
  if (is_file) check.reads("the scene file", origin);
  cli::claim_logos(check, script);
}

const Scene& scene_of(const BoundScript& script, const char* operation) {
  if (const auto* scene = std::get_if<Scene>(&script.script)) return *scene;
  throw UsageError(fmt::format("'{}' is a storyboard; '{}' takes a scene without [[part]]",
                               script.recipe.origin, operation));
}

std::span<std::uint8_t> bytes_of(const pybind11::buffer& buffer, std::size_t size_bytes) {
  const pybind11::buffer_info info = buffer.request(true);
  if (std::size_t(info.size) * std::size_t(info.itemsize) != size_bytes) {
    throw std::invalid_argument("the array has another size");
  }
  pybind11::ssize_t expected = info.itemsize;
  for (std::size_t axis = info.shape.size(); axis-- > 0;) {
    if (info.shape[axis] > 1 && info.strides[axis] != expected) {
      throw std::invalid_argument("the array has gaps");
    }
    expected *= info.shape[axis];
  }
  return {static_cast<std::uint8_t*>(info.ptr), size_bytes};
}

pybind11::bytes bytes_object(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Instant instant_of(const std::string& option, const std::string& text) {
  return *cli::OptionMap(Options{{option, text}}).value(option, parse_instant);
}

std::string hexadecimal(const Integer& value) { return value.get_str(16); }

void bind_script(py::module_& module) {
  py::class_<BoundScript, std::shared_ptr<BoundScript>>(
      module, "Script", "A scene or a storyboard, as the library has it.")
      .def(py::init(&make), py::arg("origin"), py::arg("text"), py::arg("is_file"), py::arg("keys"),
           "From the text of a scene file, named by its origin, and (keyword, key, texts).")
      .def_property_readonly(
          "is_storyboard",
          [](const BoundScript& bound) { return std::holds_alternative<Storyboard>(bound.script); })
      .def_property_readonly("is_transparent",
                             [](const BoundScript& bound) {
                               return view_of(bound.script).background == Background::transparent;
                             })
      .def_property_readonly("size", &size_of, "Width and height of a frame, in pixels.")
      .def_property_readonly("rate", &rate_of, "Frames a second: numerator and denominator.")
      .def_property_readonly("notes", &notes_of, "What a user should know of the counts.")
      .def("describe", &description, "Keys and values as exact text; equal for equal scripts.")
      .def(
          "to_toml", [](const BoundScript& bound) { return py::bytes(scene_toml(bound.script)); },
          "The text of a scene file that reads back as the same script.")
      .def("count", &count_of, "The number of collisions, in hexadecimal digits.");
  module.def("check_keys", &check_keys, py::arg("keys"),
             "Raises UsageError if keywords of one call set the same value.");
  module.def("key_names", &key_names, "All keys of a scene file, such as 'view.size'.");
  module.def("nearest_name", &nearest_name, py::arg("word"), py::arg("names"),
             "The name that the word may have been meant to be; '' if none is near.");
  module.def(
      "scenes",
      [] {
        std::vector<std::pair<std::string, std::string>> scenes;
        for (const ShippedScene& scene : shipped_scenes()) {
          scenes.emplace_back(scene.name, scene.summary());
        }
        return scenes;
      },
      "Name and summary of each shipped scene.");
  module.def(
      "scene_text",
      [](const std::string& name) { return std::string(find_shipped_scene(name).text); },
      py::arg("name"), "The scene file of a shipped scene.");
}

}  // namespace piblocks::python
