#include "render/video_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <vector>

#include "core/text.hpp"
#include "draw/number_text.hpp"
#include "scene/counted_pi.hpp"

namespace piblocks {
namespace {

/// All of a run. @param is_endless  whether `total` stands for infinitely many
std::string all_collisions(const Integer& total, bool is_endless) {
  return is_endless ? "infinitely many collisions" : collisions(total);
}

/// "3 blocks", "200 discs"
std::string bodies_of(const System& system) {
  return counted(std::ssize(system.bodies), system.dimensions == 1 ? "block" : "disc");
}

/// "Masses 1 and 100", "3 blocks"
std::string bodies_name(const Log& log) {
  if (!log.pair()) return bodies_of(log.system());
  const TwoBlocks& system = log.pair()->blocks();
  return fmt::format("Masses {} and {}", short_text(system.blue.mass), short_text(system.red.mass));
}

std::string motion_words(const Block& block) {
  if (block.velocity == 0) return "rests";
  return block.velocity < 0 ? "slides towards the wall" : "slides away from the wall";
}

std::string reached(const ShownRun& run) {
  const std::string number = with_thousands_separators(run.at_end);
  if (run.at_end < 0) {
    const Integer left = -run.at_end;
    return fmt::format("{}: {} {} to go until time 0", number, collisions(left),
                       left == 1 ? "is" : "are");
  }
  if (!run.total) return collisions(run.at_end);
  if (*run.total == 0) return number + ": there are no collisions from time 0 on";
  if (run.is_over()) {
    const char* const then = !run.is_endless() ? "there are no more"
                             : run.log.pair()  ? "both blocks rest"
                                               : "nothing more is computed";
    return fmt::format("{}, after which {}", all_collisions(*run.total, run.is_endless()), then);
  }
  return fmt::format("{} of {}", number, all_collisions(*run.total, run.is_endless()));
}

std::string collision_words(const TwoBlocks& system) {
  if (is_elastic(system)) return "All collisions are elastic";
  return fmt::format(
      "The coefficient of restitution is {} between the blocks and {} between the inner block and "
      "the wall",
      short_text(system.blocks_restitution), short_text(system.wall_restitution));
}

std::string collision_words(const System& system) {
  if (is_elastic(system)) return "All collisions are elastic";
  const auto has_own = [](const auto& one) { return one.restitution.has_value(); };
  const bool is_one = system.restitution == system.wall_restitution &&
                      std::ranges::none_of(system.bodies, has_own) &&
                      std::ranges::none_of(system.walls, has_own);
  if (!is_one) return "Collisions lose energy";
  return fmt::format("The coefficient of restitution is {}", short_text(system.restitution));
}

/// What the counter reaches, and what that proves.
std::string count_sentences(const ShownRun& run) {
  const int base = run.scene.show.base;
  std::string text = fmt::format("a counter reaches {}.", reached(run));
  if (base != kUsualBase && !(run.is_over() && run.is_endless())) {
    text += fmt::format(" It is written in base {}: {}.", base, count_text(run.at_end, base));
  }
  if (const auto pi = pi_of(run)) text += fmt::format(" The count has {}.", pi->words);
  if (const auto proof = diagram_proof(run)) text += " " + proof->words;
  return text;
}

std::string describe_scene(const ShownRun& run) {
  if (!run.log.pair()) {
    const System& system = run.log.system();
    return fmt::format(
        "{} {} {} without friction{}. {}, and {}", bodies_of(system),
        system.bodies.size() == 1 ? "moves" : "move",
        system.dimensions == 1 ? "along a line" : "in a plane",
        system.walls.empty() ? "" : ", with " + counted(std::ssize(system.walls), "wall"),
        collision_words(system), count_sentences(run));
  }
  const TwoBlocks& system = run.log.pair()->blocks();
  return fmt::format(
      "Two blocks slide along a line without friction: the inner one, beside a wall on the {}, has "
      "mass {}, the outer one mass {}. At time 0 the inner one {} and the outer one {}. {}, and {}",
      system.side > 0 ? "left" : "right", short_text(system.blue.mass), short_text(system.red.mass),
      motion_words(system.blue), motion_words(system.red), collision_words(system),
      count_sentences(run));
}

/// A run among others.
std::string describe_briefly(const ShownRun& run) {
  const std::string title = own_title(run.scene);
  std::string bodies = bodies_of(run.log.system());
  if (run.log.pair()) {
    const TwoBlocks& system = run.log.pair()->blocks();
    bodies = fmt::format("Two blocks of masses {} and {} beside a wall",
                         short_text(system.blue.mass), short_text(system.red.mass));
  }
  std::string text = title.empty() ? bodies : fmt::format("“{}”: {}", title, bodies);
  if (run.at_end != 0) text += (bodies.starts_with("1 ") ? " has " : " have ") + last_count(run);
  if (const auto pi = pi_of(run)) text += ": " + pi->words;
  text += ".";
  if (const auto proof = diagram_proof(run)) text += " " + proof->words;
  return text;
}

std::string describe(const SeenSegment& seen) {
  const auto runs = seen.runs();
  if (runs.empty()) {
    const auto& [lines, length_s, becomes] = seen.segment().card();
    return fmt::format("“{}”.", words_of(becomes.empty() ? lines : becomes, " / "));
  }
  std::vector<std::string> sentences;
  if (runs.size() > 1) sentences.push_back(fmt::format("{} runs at once.", runs.size()));
  for (const FilmRun& run : runs) sentences.push_back(describe_briefly(shown(run, seen)));
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace

std::vector<Integer> SeenSegment::counts(const FilmRun& run) const {
  std::vector<Integer> shown;
  for (std::int64_t frame = begin; frame < end; ++frame) {
    shown.push_back(run.log().count_at(segment().schedule()->time_of(frame)));
  }
  return shown;
}

std::vector<SeenSegment> seen_segments(const Film& film) {
  std::vector<SeenSegment> parts;
  for (const PlacedSegment& placed : film.segments()) {
    const std::int64_t begin = placed.first_seen();
    if (!parts.empty()) parts.back().end = begin - parts.back().placed.first_frame;
    parts.push_back({placed, begin - placed.first_frame, placed.segment.frame_count()});
  }
  return parts;
}

ShownRun shown(const FilmRun& run, const SeenSegment& seen) {
  const Log& log = run.log();
  const std::int64_t last = std::clamp(seen.segment().furthest_frame(), seen.begin, seen.end - 1);
  const Integer at_end = log.count_at(seen.segment().schedule()->time_of(last));
  const bool is_known = log.knows_last() || !log.has(at_end + 1);
  return {run.scene(), log, at_end, is_known ? std::optional(log.last()) : std::nullopt};
}

std::string collisions(const Integer& count) {
  return fmt::format("{} {}", with_thousands_separators(count),
                     count == 1 ? "collision" : "collisions");
}

std::string last_count(const ShownRun& run) {
  if (run.is_over() && run.is_endless()) return all_collisions(run.at_end, true);
  return collisions(abs(run.at_end)) + (run.at_end < 0 ? " to go until time 0" : "");
}

std::optional<Proof> pi_of(const ShownRun& run) {
  constexpr std::size_t kMostShown = 40;
  const int base = run.scene.show.base;
  if (!run.log.pair() || !run.is_over() || run.is_endless()) return std::nullopt;
  const std::string digits = counted_pi(run.log.pair()->blocks(), run.at_end, base);
  if (digits.empty()) return std::nullopt;
  const std::size_t count = run.at_end.get_str(base).size();
  const std::string in_base = base == kUsualBase ? "" : fmt::format(" in base {}", base);
  std::string words = (count == 1 ? "the first digit of π"
                                  : fmt::format("the first {} digits of π", readable(count))) +
                      in_base;
  if (count > kMostShown) return Proof{words, words};
  return Proof{words + ", " + digits, fmt::format("π = {}…{}", digits, in_base)};
}

std::optional<Proof> diagram_proof(const ShownRun& run) {
  if (!run.log.pair() || !run.is_over()) return std::nullopt;
  const std::string number = half_turn_text(run.log.pair()->blocks());
  if (number.empty()) return std::nullopt;
  for (const Panel panel : run.scene.show.panels) {
    if (panel == Panel::velocity || panel == Panel::ellipse) {
      return Proof{"Each hit cuts off an arc of 2θ on the circle of speeds: " + number, number};
    }
    if (panel == Panel::unfolded || panel == Panel::mirrors) {
      const std::string angles = with_thousands_separators(run.at_end);
      return Proof{fmt::format("{} equal angles θ fit into half a turn: {}", angles, number),
                   number};
    }
  }
  return std::nullopt;
}

std::string own_title(const Scene& scene) { return with_single_blanks(scene.show.title); }

std::string name_of(const FilmRun& run) {
  const std::string title = own_title(run.scene());
  return title.empty() ? bodies_name(run.log()) : title;
}

std::string names_of(const SeenSegment& seen, std::string_view between) {
  std::vector<std::string> names;
  for (const FilmRun& run : seen.runs()) names.push_back(name_of(run));
  return fmt::format("{}", fmt::join(names, between));
}

std::string name_of(const SeenSegment& seen) {
  if (seen.runs().empty()) return words_of(seen.segment().card().lines, " / ");
  const Scene& scene = seen.runs().front().scene();
  const bool has_diagram = seen.runs().size() == 1 && !scene.show.panels.empty();
  if (!has_diagram || !own_title(scene).empty()) return names_of(seen, ", ");
  return fmt::format("{}: {}", names_of(seen, ", "), exact_text(scene.show.panels.front()));
}

std::string words_of(const std::vector<std::string>& lines, std::string_view between) {
  std::vector<std::string> words;
  words.reserve(lines.size());
  for (const std::string& line : lines) words.push_back(with_single_blanks(line));
  std::erase(words, "");
  return fmt::format("{}", fmt::join(words, between));
}

std::string title_of(const Film& film) {
  const SeenSegment seen = seen_segments(film).front();
  if (seen.runs().empty()) return with_single_blanks(seen.segment().card().lines.front());
  const FilmRun& run = seen.runs().front();
  if (seen.runs().size() > 1 || !own_title(run.scene()).empty()) return names_of(seen, ", ");
  const ShownRun end = shown(run, seen);
  // Of two blocks all are known, also those that the film does not show.
  const Integer& count = run.log().pair() ? *end.total : end.at_end;
  return fmt::format("{}: {}", bodies_name(run.log()), all_collisions(count, end.is_endless()));
}

std::string describe_film(const Film& film) {
  const std::vector<SeenSegment> parts = seen_segments(film);
  if (film.scene() != nullptr) {
    return describe_scene(shown(film.scene()->runs().front(), parts.front()));
  }
  std::string text = fmt::format("A film in {}.", counted(std::ssize(parts), "part"));
  for (int number = 1; const SeenSegment& seen : parts) {
    text += fmt::format(" Part {}. {}", number++, describe(seen));
  }
  return text;
}

std::vector<std::string> describe_segments(const Film& film) {
  std::vector<std::string> texts;
  for (const SeenSegment& seen : seen_segments(film)) texts.push_back(describe(seen));
  return texts;
}

const char* loop_attribute(const Film& film) {
  const bool is_loop = film.scene() != nullptr && film.scene()->runs().front().scene().pacing.loop;
  return is_loop ? "loop " : "";
}

}  // namespace piblocks
