#include <fmt/format.h>
#include <piblocks/restitution.hpp>
#include <piblocks/run.hpp>

#include <algorithm>
#include <vector>

#include "core/text.hpp"
#include "draw/number_text.hpp"
#include "render/video_facts.hpp"

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
  if (count.total == 0) return number + ": there are no collisions from time 0 on";
  if (count.may_go_on) return collisions(count.at_end);
  if (count.at_end == count.total) {
    return all_collisions(count.total, count.is_endless) +
           (count.is_endless ? ", after which both blocks rest"
                             : ", after which there are no more");
  }
  return fmt::format("{} of {}", number, all_collisions(count.total, count.is_endless));
}

std::string collision_words(const BlockSystem& system) {
  if (is_elastic(system)) return "All collisions are elastic";
  return fmt::format(
      "The coefficient of restitution is {} between the blocks and {} between the inner block and "
      "the wall",
      short_text(system.blocks_restitution), short_text(system.wall_restitution));
}

/// "3 blocks", "200 discs"
std::string bodies_of(const Bodies& bodies) {
  const std::size_t count = bodies.system.bodies.size();
  const char* const name = bodies.system.dimensions == 1 ? "block" : "disc";
  return fmt::format("{} {}{}", count, name, count == 1 ? "" : "s");
}

std::string describe_bodies(const Bodies& bodies, const VideoCount& count) {
  const bool is_line = bodies.system.dimensions == 1;
  const std::size_t walls = bodies.system.walls.size();
  const std::string place =
      walls == 0 ? std::string() : fmt::format(", with {} wall{}", walls, walls == 1 ? "" : "s");
  return fmt::format(
      "{} moving {} without friction{}. All collisions are elastic, and a counter "
      "reaches {}.",
      bodies_of(bodies), is_line ? "along a line" : "in a plane", place, reached(count));
}

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
  bool is_endless = false;
};

std::string text_of(const Integer& milestone, const Extremes& counts) {
  if (milestone == 0) {
    return counts.least < 0 ? "No collision between now and time 0" : "No collision yet";
  }
  const std::string number = collisions(abs(milestone));
  if (milestone < 0) return number + " or more to go until time 0";
  if (milestone < counts.most) return number + " or more";
  if (counts.most == counts.total && counts.is_endless) return "Infinitely many collisions";
  return counts.most == counts.total ? number + ", after which there are no more" : number;
}

std::string time_text(std::int64_t frame, const Rational& frame_rate) {
  const std::int64_t ms = ceil(Rational(to_integer(frame)) * 1000 / frame_rate).get_si();
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3'600'000, ms / 60'000 % 60, ms / 1000 % 60,
                     ms % 1000);
}

}  // namespace

std::string title_of(const Scene& scene, const VideoCount& count) {
  if (std::string title = with_single_blanks(scene.show.title); !title.empty()) return title;
  if (scene.bodies) {
    return fmt::format("{}: {}", bodies_of(*scene.bodies), collisions(count.at_end));
  }
  return fmt::format("Masses {} and {}: {}", short_text(scene.system.blue.mass),
                     short_text(scene.system.red.mass),
                     all_collisions(count.total, count.is_endless));
}

std::string describe_video(const Scene& scene, const VideoCount& count) {
  if (scene.bodies) return describe_bodies(*scene.bodies, count);
  const BlockSystem& system = scene.system;
  const int base = scene.show.base;
  const bool is_infinite = count.is_endless && count.at_end == count.total;
  const std::string written =
      base == kUsualBase || is_infinite
          ? ""
          : fmt::format(" It is written in base {}: {}.", base, count_text(count.at_end, base));
  return fmt::format(
      "Two blocks slide along a line without friction: the inner one, beside a wall on the left, "
      "has mass {}, the outer one mass {}. At time 0 the inner one {} and the outer one {}. {}, "
      "and "
      "a counter reaches {}.{}",
      short_text(system.blue.mass), short_text(system.red.mass), motion_words(system.blue),
      motion_words(system.red), collision_words(system), reached(count), written);
}

std::string captions(const RunLog& run, const Schedule& schedule, const Rational& frame_rate) {
  const std::int64_t frames = film_frames(schedule);
  const Timeline& log = run.timeline();
  std::vector<Integer> shown;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    shown.push_back(log.count_at(schedule.time_of(frame)));
  }
  const Extremes counts{*std::ranges::min_element(shown), *std::ranges::max_element(shown),
                        log.size(), run.blocks() != nullptr && is_endless(*run.blocks())};
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
