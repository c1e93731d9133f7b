#include "render/video_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "core/text.hpp"
#include "draw/number_text.hpp"
#include "render/film_words.hpp"

namespace piblocks {
namespace {

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
