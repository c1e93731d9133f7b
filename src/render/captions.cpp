#include "render/captions.hpp"

#include <fmt/format.h>
#include <piblocks/interpolator.hpp>

#include <algorithm>
#include <vector>

namespace piblocks {
namespace {

struct Cue {
  std::int64_t first_frame;
  Integer milestone;
};

/// The largest power of ten that is not larger; the count itself if there are no more, or below 1.
Integer milestone_of(const Integer& count, const Integer& most) {
  if (count < 1) return 0;
  if (count == most) return most;
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, count.get_str().size() - 1);
  return power;
}

std::string text_of(const Integer& milestone, const Integer& most, const Integer& total) {
  const std::string number = with_thousands_separators(milestone);
  if (milestone == 0) return "No collision yet";
  const char* noun = milestone == 1 ? "collision" : "collisions";
  if (milestone == most) {
    return fmt::format("{} {}{}", number, noun, most == total ? ", which is all there are" : "");
  }
  return fmt::format("{} {} or more", number, noun);
}

std::string time_text(std::int64_t frame, const Rational& frame_rate) {
  const std::int64_t ms = ceil(Rational(frame) * 1000 / frame_rate).get_si();
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3'600'000, ms / 60'000 % 60, ms / 1000 % 60,
                     ms % 1000);
}

}  // namespace

std::string captions(const CollisionLog& log, const Timeline& timeline,
                     const Rational& frame_rate) {
  std::vector<Integer> counts;
  for (std::int64_t frame = 0; frame < timeline.frame_count(); ++frame) {
    counts.push_back(state_at(log, timeline.time_of(frame)).count);
  }
  const Integer most = *std::ranges::max_element(counts);
  std::vector<Cue> cues;
  for (std::int64_t frame = 0; frame < timeline.frame_count(); ++frame) {
    Integer milestone = milestone_of(counts[static_cast<std::size_t>(frame)], most);
    if (!cues.empty() && cues.back().milestone == milestone) continue;
    cues.push_back({frame, std::move(milestone)});
  }
  std::string text = "WEBVTT\n";
  for (std::size_t i = 0; i < cues.size(); ++i) {
    const std::int64_t end = i + 1 < cues.size() ? cues[i + 1].first_frame : timeline.frame_count();
    text += fmt::format("\n{} --> {}\n{}\n", time_text(cues[i].first_frame, frame_rate),
                        time_text(end, frame_rate), text_of(cues[i].milestone, most, log.size()));
  }
  return text;
}

}  // namespace piblocks
