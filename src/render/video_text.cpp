#include "render/video_text.hpp"

#include <fmt/format.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <vector>

#include "core/text.hpp"
#include "draw/number_text.hpp"
#include "scene/counted_pi.hpp"

namespace piblocks {
namespace {

std::string motion_words(const Block& block) {
  if (block.velocity == 0) return "rests";
  return block.velocity < 0 ? "slides towards the wall" : "slides away from the wall";
}

std::string collisions(const Integer& count) {
  return fmt::format("{} {}", with_thousands_separators(count),
                     count == 1 ? "collision" : "collisions");
}

/// All of a run.
std::string all_collisions(const Integer& total, bool is_endless) {
  return is_endless ? "infinitely many collisions" : collisions(total);
}

std::string reached(const VideoCount& count) {
  const std::string number = with_thousands_separators(count.at_end);
  if (count.at_end < 0) {
    const Integer left = -count.at_end;
    return fmt::format("{}: {} {} to go until time 0", number, collisions(left),
                       left == 1 ? "is" : "are");
  }
  if (!count.total) return collisions(count.at_end);
  if (*count.total == 0) return number + ": there are no collisions from time 0 on";
  if (count.at_end == *count.total) {
    return all_collisions(*count.total, count.is_endless) +
           (count.is_endless ? ", after which both blocks rest"
                             : ", after which there are no more");
  }
  return fmt::format("{} of {}", number, all_collisions(*count.total, count.is_endless));
}

std::string collision_words(const TwoBlocks& system) {
  if (is_elastic(system)) return "All collisions are elastic";
  return fmt::format(
      "The coefficient of restitution is {} between the blocks and {} between the inner block and "
      "the wall",
      short_text(system.blocks_restitution), short_text(system.wall_restitution));
}

/// "3 blocks", "200 discs"
std::string bodies_of(const System& system) {
  return counted(std::ssize(system.bodies), system.dimensions == 1 ? "block" : "disc");
}

std::string describe_bodies(const System& system, const VideoCount& count) {
  const std::string place =
      system.walls.empty() ? "" : ", with " + counted(std::ssize(system.walls), "wall");
  return fmt::format(
      "{} {} {} without friction{}. All collisions are elastic, and a counter reaches {}.",
      bodies_of(system), system.bodies.size() == 1 ? "moves" : "move",
      system.dimensions == 1 ? "along a line" : "in a plane", place, reached(count));
}

/// "the first 3 digits of π", "3.14"; empty if the run counts no digits of pi.
struct PiWords {
  std::string which;
  std::string digits;
};

PiWords pi_words(const Log& log, const Integer& total, int base) {
  constexpr std::size_t kMostOfPi = 40;
  if (!log.pair()) return {};
  std::string digits = counted_pi(log.pair()->blocks(), total, base);
  if (digits.empty()) return {};
  const std::size_t count = total.get_str(base).size();
  std::string which = count == 1 ? "the first digit of π"
                                 : fmt::format("the first {} digits of π", readable(count));
  if (base != kUsualBase) which += fmt::format(" in base {}", base);
  if (count > kMostOfPi) digits.clear();
  return {std::move(which), std::move(digits)};
}

struct Cue {
  std::int64_t first_frame;
  std::string text;
};

/// The largest power of ten that is not larger than the count, with the count's sign.
Integer milestone_of(const Integer& count) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, Integer(abs(count)).get_str().size() - 1);
  return count < 0 ? Integer(-power) : power;
}

/// What a film counts, and how its captions say so.
class CountWords {
 public:
  CountWords(const Scene& scene, const Log& log, const std::vector<Integer>& shown)
      : least_(*std::ranges::min_element(shown)), most_(*std::ranges::max_element(shown)) {
    if (log.has(most_ + 1)) return;
    is_endless_ = is_endless(log);
    if (is_endless_) return;
    ending_ = ", after which there are no more";
    const PiWords pi = pi_words(log, most_, scene.show.base);
    if (!pi.which.empty()) ending_ += ": " + pi.which;
    if (!pi.digits.empty()) ending_ += ", " + pi.digits;
  }

  /// @param stands  whether the count stays long enough to be given exactly
  std::string text(const Integer& count, bool stands) {
    if (count == 0) {
      return least_ < 0 ? "No collision between now and time 0" : "No collision yet";
    }
    if (count == most_ && count > 0) {
      return is_endless_ ? "Infinitely many collisions" : collisions(count) + ending_;
    }
    const char* const until = count < 0 ? " to go until time 0" : "";
    if (stands) {
      said_ = count;
      return collisions(abs(count)) + until;
    }
    Integer least = milestone_of(count);
    if (count > 0 && said_ <= count) least = std::max(least, said_);
    return collisions(abs(least)) + " or more" + until;
  }

 private:
  Integer least_;
  Integer most_;
  bool is_endless_ = false;
  std::string ending_;
  Integer said_ = 0;  ///< the last count that was given exactly
};

std::string time_text(std::int64_t frame, const Rational& frame_rate) {
  const std::int64_t ms = ceil(Rational(to_integer(frame)) * 1000 / frame_rate).get_si();
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3'600'000, ms / 60'000 % 60, ms / 1000 % 60,
                     ms % 1000);
}

}  // namespace

std::int64_t frames_before_reversal(const Scene& scene, const Schedule& schedule) {
  const std::int64_t frames = film_frames(schedule);
  // A loop shows its first frame and the one at which it turns back once.
  return scene.pacing.loop ? frames / 2 + 1 : frames;
}

VideoCount video_count(const Scene& scene, const Log& log, const Schedule& schedule) {
  const std::int64_t last = frames_before_reversal(scene, schedule) - 1;
  const Integer at_end = log.count_at(schedule.time_of(last));
  const bool is_known = log.knows_last() || !log.has(at_end + 1);
  return {at_end, is_known ? std::optional(log.last()) : std::nullopt, is_endless(log)};
}

std::string title_of(const Scene& scene, const Log& log, const VideoCount& count) {
  if (std::string title = with_single_blanks(scene.show.title); !title.empty()) return title;
  if (!log.pair()) return fmt::format("{}: {}", bodies_of(log.system()), collisions(count.at_end));
  const TwoBlocks& system = log.pair()->blocks();
  return fmt::format("Masses {} and {}: {}", short_text(system.blue.mass),
                     short_text(system.red.mass), all_collisions(*count.total, count.is_endless));
}

std::string describe_video(const Scene& scene, const Log& log, const VideoCount& count) {
  if (!log.pair()) return describe_bodies(log.system(), count);
  const TwoBlocks& system = log.pair()->blocks();
  const int base = scene.show.base;
  const bool is_infinite = count.is_endless && count.at_end == count.total;
  std::string written =
      base == kUsualBase || is_infinite
          ? ""
          : fmt::format(" It is written in base {}: {}.", base, count_text(count.at_end, base));
  const bool is_whole = count.at_end == count.total && !count.is_endless;
  const PiWords pi = is_whole ? pi_words(log, *count.total, base) : PiWords{};
  if (!pi.which.empty()) {
    written +=
        fmt::format(" The count has {}{}{}.", pi.which, pi.digits.empty() ? "" : ": ", pi.digits);
  }
  return fmt::format(
      "Two blocks slide along a line without friction: the inner one, beside a wall on the {}, has "
      "mass {}, the outer one mass {}. At time 0 the inner one {} and the outer one {}. {}, and a "
      "counter reaches {}.{}",
      log.pair()->blocks().side > 0 ? "left" : "right", short_text(system.blue.mass),
      short_text(system.red.mass), motion_words(system.blue), motion_words(system.red),
      collision_words(system), reached(count), written);
}

std::string captions(const Scene& scene, const Log& log, const Schedule& schedule) {
  constexpr int kLong_s = 1;
  const Rational& frame_rate = scene.view.frame_rate;
  const std::int64_t frames = film_frames(schedule);
  std::vector<Integer> shown;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    shown.push_back(log.count_at(schedule.time_of(frame)));
  }
  CountWords words(scene, log, shown);
  std::vector<Cue> cues;
  for (auto begin = shown.begin(); begin != shown.end();) {
    const auto end =
        std::find_if(begin, shown.end(), [&](const Integer& n) { return n != *begin; });
    std::string text = words.text(*begin, end - begin >= kLong_s * frame_rate);
    if (cues.empty() || cues.back().text != text) {
      cues.push_back({begin - shown.begin(), std::move(text)});
    }
    begin = end;
  }
  std::string text = "WEBVTT\n";
  for (std::size_t i = 0; i < cues.size(); ++i) {
    const std::int64_t end = i + 1 < cues.size() ? cues[i + 1].first_frame : frames;
    text += fmt::format("\n{} --> {}\n{}\n", time_text(cues[i].first_frame, frame_rate),
                        time_text(end, frame_rate), cues[i].text);
  }
  return text;
}

}  // namespace piblocks
