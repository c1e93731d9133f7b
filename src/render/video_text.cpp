#include "render/video_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "draw/number_text.hpp"
#include "scene/counted_pi.hpp"

namespace piblocks {
namespace {

/// A segment and those of its frames that show it: of a fade each neighbour has one half.
struct Part {
  const PlacedSegment& placed;
  std::int64_t begin;
  std::int64_t end;

  const FilmSegment& segment() const { return placed.segment; }
  std::span<const FilmRun> runs() const { return segment().runs(); }
  /// What the counter of a run says, frame by frame.
  std::vector<Integer> counts(const FilmRun& run) const {
    std::vector<Integer> shown;
    for (std::int64_t frame = begin; frame < end; ++frame) {
      shown.push_back(run.log().count_at(segment().schedule()->time_of(frame)));
    }
    return shown;
  }
};

std::vector<Part> parts_of(const Film& film) {
  std::vector<Part> parts;
  for (const PlacedSegment& placed : film.segments()) {
    const std::int64_t begin = placed.first_seen();
    if (!parts.empty()) parts.back().end = begin - parts.back().placed.first_frame;
    parts.push_back({placed, begin - placed.first_frame, placed.segment.frame_count()});
  }
  return parts;
}

/// A run, and the collisions that a part of the film counts.
struct ShownRun {
  const Scene& scene;
  const Log& log;
  Integer at_end;                ///< when the film has come furthest
  std::optional<Integer> total;  ///< of two blocks, and of all that the film shows to the end

  bool is_over() const { return at_end == total; }
  /// Whether `total` stands for infinitely many.
  bool is_endless() const { return piblocks::is_endless(log); }
};

ShownRun shown(const FilmRun& run, const Part& part) {
  const Log& log = run.log();
  const std::int64_t last = std::clamp(part.segment().furthest_frame(), part.begin, part.end - 1);
  const Integer at_end = log.count_at(part.segment().schedule()->time_of(last));
  const bool is_known = log.knows_last() || !log.has(at_end + 1);
  return {run.scene(), log, at_end, is_known ? std::optional(log.last()) : std::nullopt};
}

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
    const char* const then = run.is_endless() ? "both blocks rest" : "there are no more";
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

/// "3 blocks", "200 discs"
std::string bodies_of(const System& system) {
  return counted(std::ssize(system.bodies), system.dimensions == 1 ? "block" : "disc");
}

/// What the count of a run proves once it is over, in words that end with a number, and the number.
struct Proof {
  std::string words;
  std::string number;
};

/// "the first 3 digits of π in base 16, 3.24"; nothing if the run counts no digits of pi.
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

/// Of the first diagram that proves something about two blocks.
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

/// "Masses 1 and 100", "3 blocks"
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

std::string names_of(const Part& part, std::string_view between) {
  std::vector<std::string> names;
  for (const FilmRun& run : part.runs()) names.push_back(name_of(run));
  return fmt::format("{}", fmt::join(names, between));
}

/// The lines of a card.
std::string words_of(const std::vector<std::string>& lines, std::string_view between) {
  std::vector<std::string> words;
  words.reserve(lines.size());
  for (const std::string& line : lines) words.push_back(with_single_blanks(line));
  std::erase(words, "");
  return fmt::format("{}", fmt::join(words, between));
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
        "{} {} {} without friction{}. All collisions are elastic, and {}", bodies_of(system),
        system.bodies.size() == 1 ? "moves" : "move",
        system.dimensions == 1 ? "along a line" : "in a plane",
        system.walls.empty() ? "" : ", with " + counted(std::ssize(system.walls), "wall"),
        count_sentences(run));
  }
  const TwoBlocks& system = run.log.pair()->blocks();
  return fmt::format(
      "Two blocks slide along a line without friction: the inner one, beside a wall on the {}, has "
      "mass {}, the outer one mass {}. At time 0 the inner one {} and the outer one {}. {}, and {}",
      system.side > 0 ? "left" : "right", short_text(system.blue.mass), short_text(system.red.mass),
      motion_words(system.blue), motion_words(system.red), collision_words(system),
      count_sentences(run));
}

/// "31 collisions", "infinitely many collisions", "2 collisions to go until time 0"
std::string last_count(const ShownRun& run) {
  if (run.is_over() && run.is_endless()) return all_collisions(run.at_end, true);
  return collisions(abs(run.at_end)) + (run.at_end < 0 ? " to go until time 0" : "");
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

/// Frames that it takes to read a text, at least a second of them.
Rational reading_frames(std::string_view text, const Rational& frame_rate) {
  constexpr int kReadPerSecond = 20;
  const auto is_first_byte = [](char byte) { return (byte & 0xC0) != 0x80; };
  const Rational length_s = Rational(std::ranges::count_if(text, is_first_byte)) / kReadPerSecond;
  return std::max<Rational>(1, length_s) * frame_rate;
}

/// Captions by their first frames in the film.
using Cues = std::map<std::int64_t, std::string>;

/// The largest power of ten that is not larger than the count, with the count's sign.
Integer milestone_of(const Integer& count) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, Integer(abs(count)).get_str().size() - 1);
  return count < 0 ? Integer(-power) : power;
}

/// What a run counts, and how its captions say so.
class CountWords {
 public:
  CountWords(const ShownRun& run, Integer least, Rational frame_rate)
      : least_(std::move(least)),
        most_(run.at_end),
        frame_rate_(std::move(frame_rate)),
        ends_(ends_of(run)) {}

  /// @param frames  for which the count stays
  std::string text(const Integer& count, std::int64_t frames) {
    constexpr int kLong_s = 1;
    if (count == 0) {
      return least_ < 0 ? "No collision between now and time 0" : "No collision yet";
    }
    if (count == most_ && count > 0) {
      return *std::ranges::find_if(ends_.begin(), std::prev(ends_.end()), [&](const auto& end) {
        return reading_frames(end, frame_rate_) <= frames;
      });
    }
    const char* const until = count < 0 ? " to go until time 0" : "";
    if (frames >= kLong_s * frame_rate_) {
      said_ = count;
      return collisions(abs(count)) + until;
    }
    Integer least = milestone_of(count);
    if (count > 0 && said_ <= count) least = std::max(least, said_);
    return collisions(abs(least)) + " or more" + until;
  }

 private:
  /// What may be said of the highest count, the longest text first.
  static std::vector<std::string> ends_of(const ShownRun& run) {
    const std::string count = collisions(run.at_end);
    if (!run.is_over()) return {count};
    if (run.is_endless()) return {"Infinitely many collisions"};
    const auto pi = pi_of(run);
    const std::string all =
        count + ", after which there are no more" + (pi ? ": " + pi->words : "");
    if (const auto proof = diagram_proof(run)) {
      return {all + "\n" + proof->words, count + "\n" + proof->words, count + ": " + proof->number,
              count};
    }
    if (pi) return {all, count + ": " + pi->number, count};
    return {all, count};
  }

  Integer least_;
  Integer most_;
  Rational frame_rate_;
  std::vector<std::string> ends_;
  Integer said_ = 0;  ///< the last count that was given exactly
};

Cues cues_of_run(const Part& part, const Rational& frame_rate) {
  const FilmRun& run = part.runs().front();
  const std::vector<Integer> counts = part.counts(run);
  CountWords words(shown(run, part), std::ranges::min(counts), frame_rate);
  const std::string title = own_title(run.scene());
  const Rational title_frames = title.empty() ? Rational(0) : reading_frames(title, frame_rate);
  Cues cues;
  for (auto begin = counts.begin(); begin != counts.end();) {
    const auto end =
        std::find_if(begin, counts.end(), [&](const Integer& n) { return n != *begin; });
    const std::int64_t frame = begin - counts.begin();
    const std::string count = words.text(*begin, end - begin);
    cues[frame] = frame < title_frames ? fmt::format("{}\n{}", title, count) : count;
    begin = end;
  }
  return cues;
}

/// Counts that are reached before the text before them is read are added to it.
Cues cues_of_comparison(const Part& part, const Rational& frame_rate) {
  Cues cues = {{0, names_of(part, "\n")}};
  for (const FilmRun& run : part.runs()) {
    const std::vector<Integer> counts = part.counts(run);
    const ShownRun end = shown(run, part);
    std::string& text = cues[std::ranges::find(counts, end.at_end) - counts.begin()];
    if (!text.empty()) text += "\n";
    text += fmt::format("{}: {}", name_of(run), last_count(end));
  }
  for (auto cue = std::next(cues.begin()); cue != cues.end(); ++cue) {
    const auto& [frame, before] = *std::prev(cue);
    if (cue->first - frame < reading_frames(before, frame_rate))
      cue->second.insert(0, before + "\n");
  }
  return cues;
}

Cues card_cues(const Card& card, const Rational& frame_rate) {
  Cues cues{{0, words_of(card.lines, "\n")}};
  if (card.becomes.empty()) return cues;
  const Rational changes = kCardChanges * card.length_s * frame_rate;
  cues[ceil(changes).get_si()] = words_of(card.becomes, "\n");
  return cues;
}

/// By their frames from the part's beginning on.
Cues cues_of(const Part& part, const Rational& frame_rate) {
  if (part.runs().empty()) return card_cues(part.segment().card(), frame_rate);
  return part.runs().size() == 1 ? cues_of_run(part, frame_rate)
                                 : cues_of_comparison(part, frame_rate);
}

/// The text as WebVTT has it.
std::string escaped_lines(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return escaped(text);
  return escaped(text.substr(0, end)) + "\n" + escaped_lines(text.substr(end + 1));
}

/// @param point  between seconds and milliseconds
std::string time_text(std::int64_t frame, const Rational& frame_rate, char point) {
  const std::int64_t ms = ceil(Rational(to_integer(frame)) * 1000 / frame_rate).get_si();
  return fmt::format("{:02}:{:02}:{:02}{}{:03}", ms / 3'600'000, ms / 60'000 % 60, ms / 1000 % 60,
                     point, ms % 1000);
}

}  // namespace

std::string title_of(const Film& film) {
  const Part part = parts_of(film).front();
  if (part.runs().empty()) return with_single_blanks(part.segment().card().lines.front());
  const FilmRun& run = part.runs().front();
  if (part.runs().size() > 1 || !own_title(run.scene()).empty()) return names_of(part, ", ");
  const ShownRun end = shown(run, part);
  // Of two blocks all are known, also those that the film does not show.
  const Integer& count = run.log().pair() ? *end.total : end.at_end;
  return fmt::format("{}: {}", bodies_name(run.log()), all_collisions(count, end.is_endless()));
}

std::string describe_film(const Film& film) {
  const std::vector<Part> parts = parts_of(film);
  if (film.scene() != nullptr) {
    return describe_scene(shown(film.scene()->runs().front(), parts.front()));
  }
  std::string text = fmt::format("A film in {}.", counted(std::ssize(parts), "part"));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto runs = parts[i].runs();
    text += fmt::format(" Part {}.", i + 1);
    if (runs.empty()) {
      const auto& [lines, length_s, becomes] = parts[i].segment().card();
      text += fmt::format(" “{}”.", words_of(becomes.empty() ? lines : becomes, " / "));
    }
    if (runs.size() > 1) text += fmt::format(" {} runs at once.", runs.size());
    for (const FilmRun& run : runs) text += " " + describe_briefly(shown(run, parts[i]));
  }
  return text;
}

std::string captions(const Film& film, CaptionFormat format) {
  const Rational& frame_rate = film.view().frame_rate;
  Cues cues;
  for (const Part& part : parts_of(film)) {
    for (auto& [frame, text] : cues_of(part, frame_rate)) {
      if (cues.empty() || std::prev(cues.end())->second != text) {
        cues[part.placed.first_seen() + frame] = text;
      }
    }
  }
  const bool is_vtt = format == CaptionFormat::webvtt;
  std::string text = is_vtt ? "WEBVTT\n\n" : "";
  int number = 0;
  for (auto cue = cues.begin(); cue != cues.end(); ++cue) {
    const auto next = std::next(cue);
    const auto time = [&](std::int64_t frame) {
      return time_text(frame, frame_rate, is_vtt ? '.' : ',');
    };
    if (number > 0) text += '\n';
    if (++number; !is_vtt) text += fmt::format("{}\n", number);
    text += fmt::format("{} --> {}\n{}\n", time(cue->first),
                        time(next != cues.end() ? next->first : film.frame_count()),
                        is_vtt ? escaped_lines(cue->second) : cue->second);
  }
  return text;
}

std::string captions_address(const Film& film) {
  const std::string text = captions(film);
  return "data:text/vtt;base64," +
         base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

const char* loop_attribute(const Film& film) {
  const bool is_loop = film.scene() != nullptr && film.scene()->runs().front().scene().pacing.loop;
  return is_loop ? "loop " : "";
}

}  // namespace piblocks
