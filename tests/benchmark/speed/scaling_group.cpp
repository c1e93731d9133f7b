#include <fmt/format.h>

#include "speed/contest.hpp"
#include "speed/groups.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kDigits = 3;
/// The same span of time for all digits: all have their turn in it.
constexpr const char* kTo = "13.8";
/// Of the largest frames it is enough to see four chunks.
constexpr const char* kToForSizes = "8";
/// Commands of some milliseconds are run so many times as often.
constexpr int kRepetitions = 10;

Contender contender(const Workbench& bench, const std::string& series, const std::string& value,
                    std::int64_t frames, Command command, const Command& options = {}) {
  command.insert(command.end(), options.begin(), options.end());
  return {{"scaling", series, value, "piblocks", bench.program_version(), frames}, command};
}

void vary_digits(const Workbench& bench) {
  std::vector<Contender> contenders;
  for (const int digits : {3, 6, 9, 12, 20}) {
    contenders.push_back(
        contender(bench, "digits", std::to_string(digits), article_frames(digits, kTo),
                  bench.render(digits, bench.output("program.mp4")), {"--to", kTo}));
  }
  hold_contest(bench, contenders, bench.rounds);
}

void vary_size(const Workbench& bench) {
  std::vector<Contender> contenders;
  for (const char* size : {"1280x720", "1920x1080", "2560x1440", "3840x2160", "7680x4320"}) {
    contenders.push_back(contender(bench, "size", size, article_frames(kDigits, kToForSizes),
                                   bench.render(kDigits, bench.output("program.mp4")),
                                   {"--to", kToForSizes, "--size", size}));
  }
  hold_contest(bench, contenders, bench.rounds);
}

void vary_jobs(const Workbench& bench) {
  std::vector<Contender> contenders;
  for (const char* jobs : {"1", "2", "4"}) {
    contenders.push_back(contender(bench, "jobs", jobs, article_frames(kDigits),
                                   bench.render(kDigits, bench.output("program.mp4")),
                                   {"--jobs", jobs}));
  }
  hold_contest(bench, contenders, bench.rounds);
}

void vary_duration(const Workbench& bench) {
  std::vector<Contender> contenders;
  for (const char* to : {"10", "20", "40", "80", "160"}) {
    contenders.push_back(contender(bench, "duration", to, article_frames(kDigits, to),
                                   bench.render(kDigits, bench.output("program.mp4")),
                                   {"--to", to}));
  }
  hold_contest(bench, contenders, bench.rounds);
}

/// Drawing without encoding, process start included.
void draw_nothing_to_file(const Workbench& bench) {
  std::vector<Contender> contenders;
  for (const int digits : {3, 6, 9, 12, 20}) {
    contenders.push_back(contender(bench, "null", std::to_string(digits),
                                   article_frames(digits, kTo), bench.render(digits, "null"),
                                   {"--to", kTo}));
  }
  hold_contest(bench, contenders, kRepetitions * bench.rounds);
}

/// One picture, process start included.
void draw_stills(const Workbench& bench) {
  std::vector<Contender> contenders;
  for (const char* digits : {"3", "6", "9", "12", "20"}) {
    contenders.push_back(contender(bench, "still", digits, 1,
                                   {bench.program, "still", "--digits", digits, "--at", "last",
                                    "-o", bench.output("still.png")}));
  }
  hold_contest(bench, contenders, kRepetitions * bench.rounds);
}

}  // namespace

void measure_scaling(const Workbench& bench) {
  vary_digits(bench);
  vary_size(bench);
  vary_jobs(bench);
  vary_duration(bench);
  draw_nothing_to_file(bench);
  draw_stills(bench);
}

}  // namespace piblocks::benchmark
