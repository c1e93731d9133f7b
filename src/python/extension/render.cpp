#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>
#include <pybind11/stl.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "cli/render_job.hpp"
#include "cli/script_facts.hpp"
#include "core/overwrite_check.hpp"
#include "core/stop.hpp"
#include "draw/canvas.hpp"
#include "draw/look.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"
#include "render/renderings.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

RenderJob make_job(const BoundScript& bound, const std::string& output,
                   const cli::OptionMap& options) {
  refuse_standard_output(output, "render");
  RenderJob job = cli::job_of(options, output, [&](const auto& defaults, const auto& origin) {
    return defaults.empty() ? bound.script : bound.recipe.script(defaults, origin);
  });
  OverwriteCheck check;
  bound.recipe.claim_inputs(check, job.script);
  cli::claim_outputs(check, job);
  check.check();
  return job;
}

/// A step of the rendering and the seconds that it took.
using StepTimes = std::vector<std::pair<std::string, double>>;

StepTimes times_of(const Profile& profile) {
  StepTimes times;
  for (std::size_t i = 0; i < kStepNames.size(); ++i) {
    times.emplace_back(kStepNames[i], profile.steps[i]);
  }
  times.emplace_back("total", profile.total_s);
  return times;
}

/// @param progress  None, or called with the frames done and the frames in all.
/// @returns what was written, frames, notes, and the profile if it was asked for.
py::tuple render_film(const BoundScript& bound, const std::string& output, const Options& texts,
                      const py::object& progress) {
  const cli::OptionMap options(texts);
  std::optional<RenderJob> job;
  Rendered rendered;
  const bool is_told = !progress.is_none();
  run_interruptibly([&](const std::stop_token& stop, const CallBack& call) {
    job = make_job(bound, output, options);
    const auto report = [&](const Progress& now) {
      if (is_told) call([&] { progress(now.frames_done, now.frame_count); });
      // The file appears after the last report.
      check_stop(stop);
    };
    rendered = render(*job, report, stop);
    if (!rendered.aftermath.empty()) rendered.notes.push_back(rendered.aftermath);
    for (const auto& notes_of : {convention_notes, contrast_notes}) {
      std::ranges::move(notes_of(job->script), std::back_inserter(rendered.notes));
    }
  });
  return py::make_tuple(py::bytes(cli::name_of(*job)), rendered.frame_count, rendered.notes,
                        job->profile ? times_of(rendered.profile) : StepTimes());
}

void check_still(const BoundScript& bound, const std::string& output, const char* operation) {
  refuse_standard_output(output, operation);
  OverwriteCheck check;
  bound.recipe.claim_inputs(check, bound.script);
  check.writes("--output", output);
  check.check();
}

void still_file(const BoundScript& bound, const std::string& at, const std::string& output) {
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    const Instant instant = instant_of("--at", at);
    check_still(bound, output, "still");
    render_still(bound.script, instant, output, stop);
  });
}

std::vector<std::uint8_t> draw(const DrawList& list, const std::string& format,
                               const std::stop_token& stop) {
  if (format == "svg") return draw_svg(list);
  if (format == "pdf") return draw_pdf(list);
  if (format == "png") return draw_png(list, stop);
  throw UsageError(fmt::format("format {}: must be png or svg or pdf", format));
}

/// The bytes of a still file of this format.
py::bytes still_bytes(const BoundScript& bound, const std::string& at, const std::string& format) {
  std::vector<std::uint8_t> bytes;
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    bytes = draw(still_picture(bound.script, instant_of("--at", at), stop), format, stop);
  });
  return bytes_object(bytes);
}

void sheet_file(const BoundScript& bound, const std::string& output, const Options& texts) {
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    const Scene& scene = scene_of(bound, "sheet");
    check_still(bound, output, "sheet");
    render_sheet(scene, cli::sheet_instants(cli::OptionMap(texts)), output, {}, stop);
  });
}

std::int64_t join_files(const std::vector<std::string>& parts, const std::string& output,
                        bool overwrite) {
  std::int64_t frames = 0;
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    refuse_standard_output(output, "join");
    frames = join(parts, output, stop, overwrite).frame_count;
  });
  return frames;
}

}  // namespace

void refuse_standard_output(const std::string& output, const char* operation) {
  if (output != "-") return;
  throw UsageError(
      fmt::format("{}: '-' is standard output only for the command line; name a file", operation));
}

void bind_render(py::module_& module) {
  module.def("render", &render_film, py::arg("script"), py::arg("output"), py::arg("options"),
             py::arg("progress"), "Renders a film; options as 'piblocks render' has them.");
  module.def("still_file", &still_file, py::arg("script"), py::arg("at"), py::arg("output"),
             "Writes the picture at an instant.");
  module.def("still_bytes", &still_bytes, py::arg("script"), py::arg("at"), py::arg("format"),
             "The same as the bytes of a file: png, svg or pdf.");
  module.def("sheet_file", &sheet_file, py::arg("script"), py::arg("output"), py::arg("options"),
             "Writes a sheet; options as 'piblocks sheet' has them.");
  module.def("join", &join_files, py::arg("parts"), py::arg("output"), py::arg("overwrite"),
             "Joins the parts of a rendering; returns the number of frames.");
}

}  // namespace piblocks::python
