#include "render/captions.hpp"

#include <fmt/format.h>
#include <piblocks/run.hpp>

#include <algorithm>
#include <vector>

namespace piblocks {
namespace {

struct Cue {
  std::int64_t first_frame;
  Integer milestone;
};

/// The largest power of ten that is not larger than the count, with the count's sign. The count
/// itself if it is 0, or the most that the film shows.
Integer milestone_of(const Integer& count, const Integer& most) {
  if (count == 0 || (count == most && count > 0)) return count;
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, Integer(abs(count)).get_str().size() - 1);
  return count < 0 ? Integer(-power) : power;
}

/// What the captions of a film have in common.
struct Extremes {
  Integer least;  ///< count
  Integer most;   ///< count
  Integer total;  ///< of the run
};

std::string text_of(const Integer& milestone, const Extremes& counts) {
  if (milestone == 0) {
    return counts.least < 0 ? "No collision between now and time 0" : "No collision yet";
  }
  const std::string number = with_thousands_separators(abs(milestone));
  const char* noun = abs(milestone) == 1 ? "collision" : "collisions";
  if (milestone < 0) return fmt::format("{} {} or more to go until time 0", number, noun);
  if (milestone < counts.most) return fmt::format("{} {} or more", number, noun);
  const bool is_all = counts.most == counts.total;
  return fmt::format("{} {}{}", number, noun, is_all ? ", which is all there are" : "");
}

std::string time_text(std::int64_t frame, const Rational& frame_rate) {
  const std::int64_t ms = ceil(Rational(frame) * 1000 / frame_rate).get_si();
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3'600'000, ms / 60'000 % 60, ms / 1000 % 60,
                     ms % 1000);
}

}  // namespace

std::string captions(const CollisionLog& log, const Schedule& schedule,
                     const Rational& frame_rate) {
  const std::int64_t frames = film_frames(schedule);
  std::vector<Integer> shown;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    shown.push_back(log.state_at(schedule.time_of(frame)).count);
  }
  const Extremes counts{*std::ranges::min_element(shown), *std::ranges::max_element(shown),
                        log.size()};
  std::vector<Cue> cues;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    Integer milestone = milestone_of(shown[static_cast<std::size_t>(frame)], counts.most);
    if (!cues.empty() && cues.back().milestone == milestone) continue;
    cues.push_back({frame, std::move(milestone)});
  }
  std::string text = "WEBVTT\n";
  for (std::size_t i = 0; i < cues.size(); ++i) {
    const std::int64_t end = i + 1 < cues.size() ? cues[i + 1].first_frame : frames;
    text += fmt::format("\n{} --> {}\n{}\n", time_text(cues[i].first_frame, frame_rate),
                        time_text(end, frame_rate), text_of(cues[i].milestone, counts));
  }
  return text;
}

}  // namespace piblocks
