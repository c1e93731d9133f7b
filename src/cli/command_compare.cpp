#include <piblocks/compare.hpp>

#include "cli/command.hpp"
#include "cli/comparison.hpp"
#include "cli/tolerance_options.hpp"

namespace piblocks::cli {
namespace {

void run_compare(const Command& options) {
  ComparisonJob job{*options.text("REFERENCE"), *options.text("ACTUAL")};
  job.is_recursive = !options.is_given("--no-recursive");
  read_tolerance(options, job);
  run_comparison(options, job);
}

}  // namespace

void define_compare(Command& command) {
  command.add_argument("REFERENCE",
                       "What is expected: a PNG file, a folder of them, FRAMES/%06d.png,\n"
                       "a video, or hashes (*.framehash)");
  command.add_argument("ACTUAL",
                       "What is to be judged: the same; a video may be compared with pictures");
  define_tolerance(command);
  command.add_flag("--no-recursive", "Leave out the folders in a folder");
  define_reports(command);
  command.set_footer(
      "Pictures are paired by name: those of folders by their paths in these, those of a pattern\n"
      "by their numbers. Beside a video they are paired by their order.\n"
      "Every sample has to be equal unless a tolerance is given; of several, all have to hold.\n"
      "Samples are compared as they are stored, alpha too, at up to 16 bits.\n"
      "The comparison goes on after whatever it finds, and reports are written. The first line "
      "that\n"
      "holds is the exit code:\n"
      "  2  wrong usage\n"
      "  5  something cannot be read, or all of ACTUAL is missing\n"
      "  3  all of REFERENCE is missing\n"
      "  4  a picture is missing, new, of another size, or shown another way\n"
      "  1  a picture is different, or a report could not be written\n"
      "  0  all is equal or accepted\n\n"
      "Examples:\n"
      "  piblocks compare expected.png actual.png --diff differences\n"
      "  piblocks compare golden/%06d.png frames/%06d.png --report report.html\n"
      "  piblocks compare pi.mp4 frames --max-delta 96");
  command.on_run([command] { run_compare(command); });
}

}  // namespace piblocks::cli
