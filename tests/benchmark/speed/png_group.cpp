#include <algorithm>
#include <set>
#include <thread>

#include "speed/contest.hpp"
#include "speed/groups.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kDigits = 3;

/// What png_writer knows.
struct Writer {
  const char* name;
  const char* option;
  int share;  ///< it writes the first 1/share of the frames
};

constexpr Writer kWriters[] = {
    {"cairo_surface_write_to_png", "cairo", 16},
    {"libpng level 1 with filter Up", "libpng1-up", 16},
    {"libpng level 1", "libpng1", 16},
    {"libpng level 6", "libpng6", 16},
};

Subject subject_of(const std::string& name, unsigned threads, const std::string& version,
                   std::int64_t frames) {
  return {"png", "png", std::to_string(threads), name, version, frames};
}

Contender program_on(const Workbench& bench, unsigned threads, std::int64_t frames) {
  Command command = bench.render(kDigits, bench.output("%06d.png"));
  command.insert(command.end(), {"--jobs", std::to_string(threads)});
  return {subject_of("piblocks", threads, bench.program_version(), frames), command};
}

Contender writer_on(const Workbench& bench, const Writer& writer, unsigned threads,
                    std::int64_t all_frames) {
  const std::int64_t frames = all_frames / writer.share;
  const std::string version = last_line(bench.runner.run({PNG_WRITER, "--version"}).out);
  return {subject_of(writer.name, threads, version, frames),
          {PNG_WRITER, writer.option, "--frames", std::to_string(frames), "--jobs",
           std::to_string(threads), bench.output(".")}};
}

}  // namespace

void measure_png(const Workbench& bench) {
  const std::int64_t frames = article_frames(kDigits);
  for (const unsigned threads : std::set{1U, std::max(1U, std::thread::hardware_concurrency())}) {
    std::vector<Contender> contenders = {program_on(bench, threads, frames)};
    for (const Writer& writer : kWriters) {
      contenders.push_back(writer_on(bench, writer, threads, frames));
    }
    hold_contest(bench, contenders, bench.rounds);
  }
}

}  // namespace piblocks::benchmark
