#include <unistd.h>

#include "speed/contest.hpp"
#include "speed/groups.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kDigits = 3;
/// Debian's, which finds Debian's modules, whatever other one the path has.
constexpr const char* kPython = "/usr/bin/python3";

/// A script of the folder peers.
struct Peer {
  const char* name;
  const char* script;
  int share;  ///< it renders the first 1/share of the frames
  const char* option = nullptr;
};

constexpr Peer kPeers[] = {
    {"pycairo into ffmpeg", "pycairo_pipe.py", 1},
    {"OpenCV VideoWriter", "opencv_writer.py", 1},
    {"Pillow into ffmpeg", "pillow_pipe.py", 2},
    {"matplotlib FuncAnimation", "matplotlib_animation.py", 2},
    {"matplotlib with axes", "matplotlib_animation.py", 4, "--axes"},
    {"gnuplot and ffmpeg", "gnuplot_frames.py", 8},
};

/// The program and others, the program first.
struct Contest {
  const char* series;
  std::int64_t frames;
  std::vector<Contender> contenders{};
};

void add(Contest& contest, const std::string& name, const std::string& version, std::int64_t frames,
         Command command) {
  contest.contenders.push_back(
      {{"job", contest.series, std::to_string(kDigits), name, version, frames},
       std::move(command)});
}

Contest contest_of_program(const Workbench& bench, const char* series) {
  Contest contest{series, article_frames(kDigits)};
  add(contest, "piblocks", bench.program_version(), contest.frames,
      bench.render(kDigits, bench.output("program.mp4")));
  return contest;
}

/// The first line without what follows the version.
std::string short_version(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.substr(0, line.find(" Copyright"));
}

void add_if_there(const Workbench& bench, Contest& contest, const std::string& name,
                  std::int64_t frames, const Command& version_command, Command command) {
  const Finished version = bench.runner.try_run(version_command);
  if (version.exit_code != 0) return print_skipped(name, last_line(version.err));
  add(contest, name, short_version(version.out), frames, std::move(command));
}

void add_peer(const Workbench& bench, Contest& contest, const Peer& peer) {
  const std::int64_t frames = contest.frames / peer.share;
  // Without -B, Python would leave its compiled modules in the source tree.
  const Command script = {kPython, "-B", std::string(PEERS_FOLDER "/") + peer.script};
  Command version = script;
  version.emplace_back("--version");
  Command command = script;
  if (peer.option != nullptr) command.emplace_back(peer.option);
  command.insert(command.end(), {"--frames", std::to_string(frames), bench.output("peer.mp4")});
  add_if_there(bench, contest, peer.name, frames, version, command);
}

/// By themselves: the other programs would drive gigabytes of frames out of the cache.
void measure_encoding(const Workbench& bench) {
  constexpr int kRepetitions = 3;
  const std::string y4m = bench.kept("frames.y4m");
  bench.runner.run(bench.render(kDigits, y4m));
  sync();  // what is still to be written would slow the first rounds
  Contest contest = contest_of_program(bench, "encoding");
  add_if_there(bench, contest, "ffmpeg from y4m", contest.frames, {"ffmpeg", "-version"},
               ffmpeg_ultrafast(y4m, bench.output("ffmpeg.mp4")));
  hold_contest(bench, contest.contenders, kRepetitions * bench.rounds);
  std::filesystem::remove(y4m);
}

}  // namespace

void measure_job(const Workbench& bench) {
  measure_encoding(bench);
  Contest contest = contest_of_program(bench, "drawing");
  for (const Peer& peer : kPeers) add_peer(bench, contest, peer);
  hold_contest(bench, contest.contenders, bench.rounds);
}

}  // namespace piblocks::benchmark
