#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>

#include <chrono>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "cli/render_job.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/overwrite_check.hpp"
#include "core/text.hpp"

namespace piblocks::cli {
namespace {

/// 29.97 is taken for 30000/1001.
void note_frame_rate(const Command& options, const Rational& rate) {
  const auto given = options.text("--fps");
  if (!given || parse_rational(*given) == rate) return;
  say("piblocks: note: --fps {} is {}, as in broadcasting; for another rate write a fraction\n",
      *given, rate.get_str());
}

void run_render(const Command& options, const SceneOptions& scene) {
  refuse_terminal(options);
  const RenderJob job = job_of(
      options, output_of(options),
      [&](const auto& defaults, const auto& origin) { return scene.script(defaults, origin); });
  OverwriteCheck check;
  scene.add_inputs(check, job.script);
  claim_outputs(check, job);
  check.check();
  const bool quiet = options.is_given("--quiet");
  const StopOnSignals signals;
  ProgressReport report(name_of(job), quiet);
  const Rendered rendered = render(
      job, [&](const Progress& progress) { report.update(progress); }, signals.token());
  report.finish(rendered.aftermath);
  if (job.profile) print_profile(rendered);
  if (quiet) return;
  note_all(rendered.notes);
  note_frame_rate(options, view_of(job.script).frame_rate);
  note_convention_and_contrast(job.script);
  if (report.is_seen() && !scene.has_scene())
    say("for a lecture: piblocks render why-pi -o why-pi.mp4\n");
}

void add_encoder_options(Command& command) {
  command.add_value("--crf", "Q", "Rate factor, 1 (best) to 51 (worst); 0 to 63 for WebM");
  command.add_value("--preset", "P", "The encoder's speed preset, such as veryfast");
  command.add_value("--encoder", "NAME", "Video encoder; 'piblocks info' lists them");
  command.add_flag("--smallest",
                   "Smallest MP4, by libx264: under half the size, and many\ntimes the time");
  command.add_value("--start-number", "N",
                    "Number of the first picture of a sequence (default: 1); with\n"
                    "this option, pictures with higher numbers stay");
  command.add_value("--plays", "N", "How often a GIF, APNG or WebP plays (default: for ever)");
}

void add_overwrite(Command& command) {
  command.add_flag("--overwrite",
                   "Let pictures of a sequence, and files of --bundle and --part,\n"
                   "replace files that no earlier run has made");
}

void add_run_options(Command& command) {
  command.add_value("--jobs", "N",
                    "Threads (default: one for each processor that the process may\nuse); changes "
                    "no byte of the output");
  command.add_value("--frames", "A-B",
                    "Render frames A to B alone; the first of the film is 0. Pictures\n"
                    "of a sequence get the numbers that they have in the whole one,\n"
                    "and its others stay");
  command.add_value("--part", "I/N",
                    "Render the I-th of N shares to OUT.part-I-of-N,\nfor 'piblocks join'");
  command.add_value("--bundle", "DIR",
                    "Write OUT, an MP4, into DIR, with a poster, captions, alt text\n"
                    "and slides for LaTeX beamer and reveal.js beside it; of a\n"
                    "storyboard also a video and a slide for each part");
  command.add_value("--poster", "T",
                    "Instant that the poster shows (default: the last frame; of a\n"
                    "storyboard, that of the last run with a diagram)");
  command.add_value("--captions", "inside",
                    "Give the MP4 a track of captions: those that --bundle writes\n"
                    "beside it");
  command.add_value("--max-flashes", "N",
                    "Render nothing if the film would flash more than N times\n"
                    "within a second; 3 are held to be harmless (WCAG 2.3.1)");
  command.add_flag("--resume",
                   "Keep the pictures of a sequence that an interrupted run of the\n"
                   "same command has left; if interrupted, leave what there is.\n"
                   "With --part, keep a part that has been made already");
  add_overwrite(command);
  command.add_flag("--profile", "Print what each stage cost, on standard error");
  command.add_flag("--quiet", "Print nothing but errors, and what --profile asks for");
}

void run_join(const Command& options) {
  const StopOnSignals signals;
  refuse_terminal(options);
  const std::vector<std::string> parts = options.texts("PART");
  const std::string output = output_of(options);
  const Rendered joined = join(parts, output, signals.token(), options.is_given("--overwrite"));
  if (options.is_given("--quiet")) return;
  say("{}: {} from {}{}\n", output == "-" ? "standard output" : output,
      counted(joined.frame_count, "frame"), counted(std::ssize(parts), "part"),
      after_semicolon(joined.aftermath));
}

void run_still(const Command& options, const SceneOptions& scene_options) {
  refuse_terminal(options);
  const Script script = scene_options.script();
  scene_options.check_output(script);
  const StopOnSignals signals;
  const std::string output = output_of(options);
  note_all(render_still(script, *options.value("--at", parse_instant), output, signals.token()));
  note_convention_and_contrast(script);
  if (has_ending(output, ".svg") || has_ending(output, ".pdf")) note_sharp(script);
}

void run_sheet(const Command& options, const SceneOptions& scene_options) {
  refuse_terminal(options);
  const Scene scene = scene_options.scene();
  scene_options.check_output(scene);
  const SheetInstants instants = sheet_instants(options);
  const StopOnSignals signals;
  ProgressReport report(output_of(options), false,
                        {.unit = "pictures", .delay = std::chrono::seconds(1)});
  note_all(render_sheet(
      scene, instants, output_of(options),
      [&](const Progress& progress) { report.update(progress); }, signals.token()));
  note_convention_and_contrast(scene);
  note_sharp(scene);
}

}  // namespace

void define_render(Command& command) {
  SceneOptions scene(command);
  command.add_required_value("-o,--output", "OUT",
                             "What to write: NAME.mp4, NAME.mov, NAME.webm, NAME.gif,\n"
                             "NAME.apng, NAME.webp, FRAMES/%06d.png or .svg, NAME.pdf: a\n"
                             "page for each frame, NAME.y4m, - (y4m on standard output),\n"
                             "NAME.framehash, null, NAME.wav: the sound alone, or\n"
                             "NAME.html: a page with the video, captions and frame steps;\n"
                             "for one with the program, 'piblocks page'");
  command.add_value("--for", "WHERE",
                    "Size, rate and background that suit one of:\n" + destination_names());
  scene.add_picture();
  scene.add_show();
  scene.add_exposure();
  scene.add_timing();
  scene.add_sound();
  add_encoder_options(command);
  add_run_options(command);
  command.set_footer(
      "Examples:\n"
      "  piblocks render -o pi.mp4\n"
      "  piblocks render --digits 5 --speed 1/2 --size 1280x720 -o frames/%06d.png\n"
      "  piblocks render scene.toml --to last+3 -o - | ffplay -colorspace bt709 -");
  command.on_run([=] { run_render(command, scene); });
}

void define_join(Command& command) {
  command.add_arguments("PART", "Every file of 'render --part', in any order");
  command.add_required_value("-o,--output", "OUT", "The name that the parts were rendered for");
  command.add_flag("--overwrite", "Let pictures of a sequence replace other files");
  command.add_flag("--quiet", "Print nothing but errors");
  command.set_footer(
      "Examples:\n"
      "  piblocks render --part 1/2 -o pi.mp4    # on one machine: pi.mp4.part-1-of-2\n"
      "  piblocks render --part 2/2 -o pi.mp4    # on another: pi.mp4.part-2-of-2\n"
      "  piblocks join pi.mp4.part-* -o pi.mp4   # the bytes of 'piblocks render -o pi.mp4'");
  command.on_run([=] { run_join(command); });
}

void define_still(Command& command) {
  SceneOptions scene(command);
  command.add_required_value("--at", "T",
                             "Instant: a time, 'turn', 'last', or '#K' for collision K; an\n"
                             "offset may follow, as in turn-0.3 and last+1. Of a storyboard:\n"
                             "a second of its video, or 'last' for its last frame");
  command.add_required_value("-o,--output", "OUT",
                             "NAME.png, NAME.svg, NAME.pdf, or - (PNG on standard output)");
  scene.add_picture();
  scene.add_show();
  scene.add_exposure();
  command.set_footer(
      "Examples:\n"
      "  piblocks still --at 3.5 -o turn.svg\n"
      "  piblocks still scene.toml --at '#10' --size 640x360 -o tenth.png");
  command.on_run([=] { run_still(command, scene); });
}

void define_sheet(Command& command) {
  SceneOptions scene(command);
  command.add_value("--frames", "N", "So many instants, spread over the run (default 12)");
  command.add_value("--by", "WHAT",
                    "Spread them evenly by 'count' of collisions or by 'time'\n"
                    "(default: by count if the turn is shown and no two pictures\n"
                    "would have the same count; otherwise by time)");
  command.add_value("--at", "T[,T...]", "Or these instants: 3.5, turn-0.3, last+1, '#314'");
  command.add_required_value("-o,--output", "OUT",
                             "NAME.pdf, NAME.png, NAME.svg, or - (PNG on standard output)");
  scene.add_size();
  scene.add_show();
  scene.add_span();
  command.set_footer(
      "Examples:\n"
      "  piblocks sheet -o sheet.pdf\n"
      "  piblocks sheet --digits 2 --frames 32 --by count -o every-collision.pdf\n"
      "  piblocks sheet --digits 2 --at '0,#1,#10,#20,last' -o collisions.svg");
  command.on_run([=] { run_sheet(command, scene); });
}

}  // namespace piblocks::cli
