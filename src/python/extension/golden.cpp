#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>
#include <pybind11/stl.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/golden_actions.hpp"
#include "cli/script_facts.hpp"
#include "core/output_file.hpp"
#include "core/processors.hpp"
#include "core/text.hpp"
#include "golden/reports.hpp"
#include "python/extension/interruptible.hpp"
#include "python/extension/script.hpp"
#include "render/references.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// Where the references of a scene are, and what they hold.
struct GoldenPlace {
  std::string name;
  std::string folder;
  std::optional<std::string> frames;  ///< instead of the scene's
};

References references_of(const BoundScript& bound, const GoldenPlace& place) {
  ScriptBuilder builder;
  bound.recipe.fill(builder);
  if (place.frames) builder.set("--frames", "golden.frames", *place.frames);
  return {place.name, builder, place.folder};
}

/// What was found, in lines as 'piblocks golden' prints them.
struct GoldenResult {
  std::vector<std::string> lines;
  bool is_equal = true;
};

void check_outputs(const BoundScript& bound, const References& references) {
  OverwriteCheck check;
  bound.recipe.claim_inputs(check, references.script());
  for (const std::string& file : references.files()) check.writes("--dir", references.path(file));
  check.check();
}

GoldenResult act(const BoundScript& bound, const GoldenPlace& place, const std::string& action,
                 const std::optional<std::string>& diff) {
  GoldenResult result;
  const auto say = [&](const std::string& line) { result.lines.push_back(printable(line)); };
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    const References references = references_of(bound, place);
    if (action == "record") {
      check_outputs(bound, references);
      cli::check_unrecorded(references);
      cli::record_golden(references, say, stop);
    } else if (action == "approve") {
      check_outputs(bound, references);
      cli::check_pictures(references);
      cli::approve_golden(references, say, stop);
    } else {
      OverwriteCheck check;
      bound.recipe.claim_inputs(check, references.script());
      cli::claim_diff(check, {references}, place.folder, diff);
      check.check();
      result.is_equal = cli::check_golden(references, diff, say, stop);
    }
  });
  return result;
}

/// Writes the page of 'piblocks compare --report' for the pictures among the references.
/// @returns false if there are none.
bool write_report(const BoundScript& bound, const GoldenPlace& place, const std::string& page) {
  bool has_pictures = false;
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    const References references = references_of(bound, place);
    const Unfinished expected(fs::temp_directory_path() / "piblocks-golden",
                              Unfinished::Kind::folder);
    const Unfinished actual(fs::temp_directory_path() / "piblocks-golden",
                            Unfinished::Kind::folder);
    references.render_into(actual.path(), processor_count(), stop);
    for (const std::string& file : references.files()) {
      const bool is_picture = has_ending(file, ".png") && references.has(file);
      if (!is_picture) {
        fs::remove(actual.path() / file);
        continue;
      }
      fs::create_symlink(fs::absolute(references.path(file)), expected.path() / file);
      has_pictures = true;
    }
    if (!has_pictures) return;
    const ComparisonJob job{expected.path(), actual.path()};
    const auto report = html_report(page);
    const ComparisonResult result = compare_files(
        job, [&](const FrameComparison& frame) { report->add(frame); }, stop);
    report->finish(job, result);
  });
  return has_pictures;
}

}  // namespace

void bind_golden(py::module_& module) {
  module.def(
      "golden",
      [](const BoundScript& bound, const std::string& action, const std::string& name,
         const std::string& folder, const std::optional<std::string>& frames,
         const std::optional<std::string>& diff) {
        const GoldenResult result = act(bound, {name, folder, frames}, action, diff);
        return py::make_tuple(result.is_equal, result.lines);
      },
      py::arg("script"), py::arg("action"), py::arg("name"), py::arg("folder"), py::arg("frames"),
      py::arg("diff"), "'piblocks golden': record, check or approve; equality, and lines.");
  module.def(
      "golden_report",
      [](const BoundScript& bound, const std::string& name, const std::string& folder,
         const std::optional<std::string>& frames, const std::string& page) {
        return write_report(bound, {name, folder, frames}, page);
      },
      py::arg("script"), py::arg("name"), py::arg("folder"), py::arg("frames"), py::arg("page"),
      "Writes a page that lays expected and actual pictures over each other.");
}

}  // namespace piblocks::python
