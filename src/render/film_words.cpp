#include "render/film_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <utility>

#include "core/text.hpp"
#include "draw/number_text.hpp"
#include "scene/counted_pi.hpp"

namespace piblocks {

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

std::string all_collisions(const Integer& total, bool is_endless) {
  return is_endless ? "infinitely many collisions" : collisions(total);
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

std::string bodies_of(const System& system) {
  return counted(std::ssize(system.bodies), system.dimensions == 1 ? "block" : "disc");
}

std::string bodies_name(const Log& log) {
  if (!log.pair()) return bodies_of(log.system());
  const TwoBlocks& system = log.pair()->blocks();
  return fmt::format("Masses {} and {}", short_text(system.blue.mass), short_text(system.red.mass));
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

}  // namespace piblocks
