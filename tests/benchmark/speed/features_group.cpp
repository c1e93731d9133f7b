#include <string>
#include <vector>

#include "speed/contest.hpp"
#include "speed/groups.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kDigits = 3;
/// So that slow motion does not make more frames than there are without.
constexpr const char* kDuration_s = "14";
constexpr std::int64_t kFrames = 14 * 60;
/// The first frames are enough for formats that take some milliseconds each.
constexpr const char* kToForFormats = "5";

/// The article's scene with something that it does not have by default.
struct Feature {
  std::string name;
  Command options;
};

std::vector<Feature> features() {
  std::vector<Feature> features = {
      {"nothing", {}},
      {"--theme dark", {"--theme", "dark"}},
      {"--theme lecture without marks and loupe",
       {"--theme", "lecture", "--no-hits", "--loupe", "off"}},
      {"--theme lecture without loupe", {"--theme", "lecture", "--loupe", "off"}},
      {"--theme lecture", {"--theme", "lecture"}},
      {"--theme lecture and two diagrams",
       {"--theme", "lecture", "--panels", "velocity,unfolded", "--show", "masses"}},
      {"--title and --caption", {"--title", "Counting collisions", "--caption", "m = 100 kg"}},
      {"--sound", {"--sound"}},
      {"--slow-motion auto", {"--slow-motion", "auto"}},
      {"--shutter 0.5", {"--shutter", "0.5"}},
      {"--max-flashes 3", {"--max-flashes", "3"}},
      {"--width-by-mass", {"--width-by-mass"}}};
  for (const char* overlay :
       {"digits", "masses", "velocities", "energy", "momentum", "time", "ruler"}) {
    features.push_back({std::string("--show ") + overlay, {"--show", overlay}});
  }
  for (const char* panel :
       {"velocity", "position", "unfolded", "time", "count", "conservation", "certainty"}) {
    features.push_back({std::string("--panels ") + panel, {"--panels", panel}});
  }
  features.push_back({"four panels", {"--panels", "velocity,position,unfolded,time"}});
  features.push_back({"four panels and all of --show",
                      {"--panels", "velocity,position,unfolded,time", "--show",
                       "digits,masses,velocities,energy,momentum,time,ruler"}});
  return features;
}

void add_features(const Workbench& bench) {
  std::vector<Contender> contenders;
  for (const auto& [name, options] : features()) {
    Command command = bench.render(kDigits, bench.output("program.mp4"));
    command.insert(command.end(), {"--duration", kDuration_s});
    command.insert(command.end(), options.begin(), options.end());
    contenders.push_back(
        {{"features", "features", name, "piblocks", bench.program_version(), kFrames}, command});
  }
  hold_contest(bench, contenders, bench.rounds);
}

struct Format {
  const char* name;
  const char* output;
  Command options = {};
  int frames_per_s = 60;
};

void vary_format(const Workbench& bench) {
  const std::vector<Format> formats = {
      {"MP4", "program.mp4"},
      {"MOV", "program.mov"},
      {"page", "program.html"},
      {"PNG sequence", "%06d.png"},
      {"PNG sequence with alpha", "%06d.png", {"--transparent"}},
      {"APNG", "program.apng"},
      {"GIF", "program.gif", {"--fps", "50"}, 50},
      {"WebM (VP9)", "program.webm"},
      {"WebM (VP9) with alpha", "program.webm", {"--transparent"}},
      {"WebM (AV1)", "program.webm", {"--encoder", "libaom-av1"}},
      {"MOV (ProRes 4444) with alpha", "program.mov", {"--transparent"}}};
  std::vector<Contender> contenders;
  for (const auto& [name, output, options, frames_per_s] : formats) {
    Command command = bench.render(kDigits, bench.output(output));
    command.insert(command.end(), {"--to", kToForFormats});
    command.insert(command.end(), options.begin(), options.end());
    contenders.push_back({{"features", "formats", name, "piblocks", bench.program_version(),
                           article_frames(kDigits, kToForFormats, frames_per_s)},
                          command});
  }
  hold_contest(bench, contenders, bench.rounds);
}

}  // namespace

void measure_features(const Workbench& bench) {
  add_features(bench);
  vary_format(bench);
}

}  // namespace piblocks::benchmark
