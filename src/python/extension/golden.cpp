#include <piblocks/compare.hpp>
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/golden_actions.hpp"
#include "core/processors.hpp"
#include "core/text.hpp"
#include "core/unfinished.hpp"
#include "golden/reports.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"
#include "render/references.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// @param frames  instants kept as pictures, instead of the scene's
References references_of(const BoundScript& bound, const std::string& name,
                         const std::string& folder, const std::optional<std::string>& frames) {
  ScriptBuilder builder;
  bound.recipe.fill(builder);
  if (frames) builder.set("--frames", "golden.frames", *frames);
  return {name, builder, folder};
}

void check_outputs(const BoundScript& bound, const References& references) {
  OverwriteCheck check;
  bound.recipe.claim_inputs(check, references.script());
  for (const std::string& file : references.files()) check.writes("--dir", references.path(file));
  check.check();
}

void ignore_progress(const Progress& /*progress*/) {}

/// @returns whether it has succeeded, its outcome, its lines.
py::tuple act(const BoundScript& bound, const std::string& action, const std::string& name,
              const std::string& folder, const std::optional<std::string>& frames,
              const std::optional<std::string>& diff) {
  cli::GoldenResult result;
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    const References references = references_of(bound, name, folder, frames);
    if (action == "check") {
      OverwriteCheck check;
      bound.recipe.claim_inputs(check, references.script());
      cli::claim_diff(check, {references}, folder, diff);
      check.check();
      result = cli::check_golden(references, cli::temporary_folder(), diff, ignore_progress, stop);
      return;
    }
    check_outputs(bound, references);
    result = action == "record" ? cli::record_golden(references, ignore_progress, stop)
                                : cli::approve_golden(references, ignore_progress, stop);
  });
  std::ranges::transform(result.lines, result.lines.begin(), printable);
  return py::make_tuple(result.exit_code == 0, result.outcome, result.lines);
}

/// The paths of the references.
std::vector<std::string> files_of(const BoundScript& bound, const std::string& name,
                                  const std::string& folder,
                                  const std::optional<std::string>& frames) {
  const References references = references_of(bound, name, folder, frames);
  std::vector<std::string> paths;
  for (const std::string& file : references.files()) {
    paths.push_back(printable(references.path(file).string()));
  }
  return paths;
}

/// Writes the page of 'piblocks compare --report' for the pictures among the references.
/// @returns false if there are none.
bool write_report(const BoundScript& bound, const std::string& name, const std::string& folder,
                  const std::optional<std::string>& frames, const std::string& page) {
  bool has_pictures = false;
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    const References references = references_of(bound, name, folder, frames);
    const fs::path scratch = cli::temporary_folder() / "piblocks-golden";
    const Unfinished expected(scratch, Unfinished::Kind::folder);
    const Unfinished actual(scratch, Unfinished::Kind::folder);
    references.render_into(actual.path(), processor_count(), ignore_progress, stop);
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
    const auto report = html_report(page, ReportForm::one_file);
    const ComparisonResult result = compare_files(
        job, [&](const FrameComparison& frame) { report->add(frame); }, stop);
    report->finish(job, result);
  });
  return has_pictures;
}

}  // namespace

void bind_golden(py::module_& module) {
  module.def("golden", &act, py::arg("script"), py::arg("action"), py::arg("name"),
             py::arg("folder"), py::arg("frames"), py::arg("diff"),
             "'piblocks golden': record, check or approve; success, outcome, lines.");
  module.def("golden_files", &files_of, py::arg("script"), py::arg("name"), py::arg("folder"),
             py::arg("frames"), "The paths of the references, whether they are there or not.");
  module.def("golden_report", &write_report, py::arg("script"), py::arg("name"), py::arg("folder"),
             py::arg("frames"), py::arg("page"),
             "Writes a page that lays expected and actual pictures over each other.");
}

}  // namespace piblocks::python
