#include "cli/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <utility>

#include "cli/text_output.hpp"

namespace piblocks::cli {
namespace {

constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{5};
constexpr fmt::string_view kClearLine = "\r\x1b[K";

/// A terminal that obeys escape sequences.
bool is_on_terminal() {
  const char* const kind = std::getenv("TERM");  // NOLINT(concurrency-mt-unsafe): no thread sets it
  const bool is_dumb = kind != nullptr && std::string_view(kind) == "dumb";
  return !is_dumb && isatty(STDERR_FILENO) == 1;
}

/// The columns of the terminal, less one: a full line would wrap.
std::size_t columns() {
  winsize size{};
  constexpr std::size_t kUsual = 80;
  const bool is_known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return (is_known ? size.ws_col : kUsual) - 1;
}

std::string minutes_and_seconds(double duration_s) {
  const auto whole = static_cast<long>(std::lround(duration_s));
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

/// What is written, for people: not the name of a pipe.
std::string subject(const std::string& output) {
  return output == "-" ? "standard output" : output;
}

/// Chunks in a row that were encoded alike share a line.
void print_methods(const std::vector<std::string>& methods) {
  for (auto begin = methods.begin(); begin != methods.end();) {
    const auto end = std::find_if(begin, methods.end(), [&](const auto& m) { return m != *begin; });
    if (!begin->empty()) {
      say("  chunks {} to {} by {}\n", begin - methods.begin() + 1, end - methods.begin(), *begin);
    }
    begin = end;
  }
}

}  // namespace

ProgressReport::ProgressReport(std::string output, bool quiet, const CountedWork& work)
    : output_(std::move(output)), quiet_(quiet), work_(work), on_terminal_(is_on_terminal()) {}

ProgressReport::~ProgressReport() {
  if (bar_visible_) say(kClearLine);
}

double ProgressReport::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void ProgressReport::update(const Progress& progress) {
  progress_ = progress;
  const auto now = Clock::now();
  const Clock::duration interval = on_terminal_ ? Clock::duration(kBarInterval) : kLineInterval;
  const bool is_first_bar = on_terminal_ && !bar_visible_;
  if (quiet_ || now - start_ < work_.delay || (!is_first_bar && now - last_shown_ < interval))
    return;
  last_shown_ = now;
  if (on_terminal_) {
    draw_bar();
    bar_visible_ = true;
  } else {
    print_line();
  }
}

void ProgressReport::draw_bar() const {
  constexpr int kWidth = 30;
  const bool is_done = progress_.frames_done == progress_.frame_count;
  const double share = is_done ? 1 : double(progress_.frames_done) / double(progress_.frame_count);
  const int filled = static_cast<int>(share * kWidth);
  std::string line = fmt::format("[{:=<{}}{: <{}}] {:3.0f} %", "", filled, "", kWidth - filled,
                                 std::floor(100 * share));
  if (progress_.frames_done > 0) {  // otherwise there is no rate to judge by
    const double rate = double(progress_.frames_done) / elapsed_s();
    const double left_s = double(progress_.frame_count - progress_.frames_done) / rate;
    line += fmt::format("  {:.0f} {}/s  {} left", rate, work_.unit, minutes_and_seconds(left_s));
  }
  say(kClearLine);
  say("{}", std::string_view(line).substr(0, columns()));
}

void ProgressReport::print_line() const {
  say("{} of {} {}, {:.0f} {}/s\n", progress_.frames_done, progress_.frame_count, work_.unit,
      double(progress_.frames_done) / elapsed_s(), work_.unit);
}

void ProgressReport::finish(const std::string& aftermath) {
  if (quiet_) return;
  if (std::exchange(bar_visible_, false)) say(kClearLine);
  const double duration_s = elapsed_s();
  say("{}: {} in {:.2f} s ({:.0f} frames/s){}\n", subject(output_),
      counted(progress_.frame_count, "frame"), duration_s,
      double(progress_.frame_count) / duration_s, after_semicolon(aftermath));
}

void print_profile(const Rendered& rendered) {
  const Profile& profile = rendered.profile;
  const double frames = double(std::max<std::int64_t>(1, rendered.frame_count));
  const auto print = [&](std::string_view name, double spent_s) {
    say("  {:<8} {:8.3f} s {:8.4f} ms/frame {:5.1f} %\n", name, spent_s, 1000 * spent_s / frames,
        100 * spent_s / profile.total_s);
  };
  say("processor time of {} frames:\n", rendered.frame_count);
  for (std::size_t i = 0; i < profile.steps.size(); ++i) print(kStepNames[i], profile.steps[i]);
  const double steps_s = std::accumulate(profile.steps.begin(), profile.steps.end(), 0.0);
  print("other", profile.total_s - steps_s);  // start-up and set-up
  print("total", profile.total_s);
  print_methods(profile.chunk_methods);
}

}  // namespace piblocks::cli
