#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <unistd.h>

#include <regex>

#include "speed/contest.hpp"
#include "speed/groups.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kDigits = 3;
constexpr int kFrameRate = 60;

/// Of the largest frames fewer, around the turn: 10 GB of them stay in the cache.
struct Size {
  const char* text;
  int from_s;
  int to_s;
};
constexpr Size kSizes[] = {
    {"1280x720", 0, 13}, {"1920x1080", 0, 13}, {"3840x2160", 0, 13}, {"7680x4320", 5, 7}};

double number_after(const std::string& text, const std::string& words) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(words + "([0-9.]+)"))) {
    throw Error(fmt::format("ffmpeg said nothing of '{}'", words));
  }
  return std::stod(found[1]);
}

/// @param drawn  the frames that `video` was made of.
Quality quality_of(const Workbench& bench, const std::string& video, const std::string& drawn) {
  const std::string filter = "[0:v]split[a][b];[1:v]split[c][d];[a][c]psnr[p];[b][d]ssim[s]";
  const Finished finished = bench.runner.run({"ffmpeg", "-hide_banner", "-i", video, "-i", drawn,
                                              "-filter_complex", filter, "-map", "[p]", "-f",
                                              "null", "-", "-map", "[s]", "-f", "null", "-"});
  return {.psnr_dB = number_after(finished.err, "PSNR .*average:"),
          .least_psnr_dB = number_after(finished.err, "PSNR .*min:"),
          .ssim = number_after(finished.err, "SSIM .*All:")};
}

void measure_size(const Workbench& bench, const Size& size) {
  const auto render = [&](const std::string& output, const Command& options = {}) {
    Command command = bench.render(kDigits, output);
    command.insert(command.end(), {"--size", size.text, "--from", std::to_string(size.from_s),
                                   "--to", std::to_string(size.to_s)});
    command.insert(command.end(), options.begin(), options.end());
    return command;
  };
  const std::string drawn = bench.kept("drawn.y4m");
  bench.runner.run(render(drawn));
  sync();  // what is still to be written would slow the first rounds

  const std::string video = bench.output("video.mp4");
  const auto contender = [&](const std::string& name, const std::string& version,
                             const Command& command) {
    const std::int64_t frames = kFrameRate * (size.to_s - size.from_s);
    return Contender{{"encoders", size.text, size.text, name, version, frames}, command, [&] {
                       return quality_of(bench, video, drawn);
                     }};
  };
  const std::string version = bench.program_version();
  hold_contest(bench,
               {contender("piblocks builtin", version, render(video, {"--encoder", "builtin"})),
                contender("piblocks by libx264", version, render(video, {"--encoder", "libx264"})),
                contender("ffmpeg from y4m", "ffmpeg", ffmpeg_ultrafast(drawn, video))},
               bench.rounds);
  std::filesystem::remove(drawn);
}

}  // namespace

void measure_encoders(const Workbench& bench) {
  for (const Size& size : kSizes) measure_size(bench, size);
}

}  // namespace piblocks::benchmark
