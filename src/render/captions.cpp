#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "core/text.hpp"
#include "render/video_text.hpp"

namespace piblocks {
namespace {

/// Frames that it takes to read a text, at least a second of them.
std::int64_t reading_frames(std::string_view text, const Rational& frame_rate) {
  constexpr int kReadPerSecond = 20;
  const auto is_first_byte = [](char byte) { return (byte & 0xC0) != 0x80; };
  const Rational length_s = Rational(std::ranges::count_if(text, is_first_byte)) / kReadPerSecond;
  return ceil(std::max<Rational>(1, length_s) * frame_rate).get_si();
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
    if (count == 0) {
      return least_ < 0 ? "No collision between now and time 0" : "No collision yet";
    }
    if (count == most_ && count > 0) {
      return *std::ranges::find_if(ends_.begin(), std::prev(ends_.end()), [&](const auto& end) {
        return reading_frames(end, frame_rate_) <= frames;
      });
    }
    const char* const until = count < 0 ? " to go until time 0" : "";
    if (to_integer(frames) >= frame_rate_) {  // a second
      said_ = count;
      return collisions(abs(count)) + until;
    }
    Integer least = milestone_of(count);
    if (count > 0 && said_ <= count) least = std::max(least, said_);
    return collisions(abs(least)) + " or more" + until;
  }

 private:
  /// Texts for the highest count, the longest first: the first one is shown for which there is
  /// time.
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

Cues cues_of_run(const SeenSegment& seen, const Rational& frame_rate) {
  const FilmRun& run = seen.runs().front();
  const std::vector<Integer> counts = seen.counts(run);
  CountWords words(shown(run, seen), std::ranges::min(counts), frame_rate);
  const std::string title = own_title(run.scene());
  const std::int64_t title_frames = title.empty() ? 0 : reading_frames(title, frame_rate);
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
Cues cues_of_comparison(const SeenSegment& seen, const Rational& frame_rate) {
  Cues cues = {{0, names_of(seen, "\n")}};
  for (const FilmRun& run : seen.runs()) {
    const std::vector<Integer> counts = seen.counts(run);
    const ShownRun end = shown(run, seen);
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

/// By their frames from the beginning of the segment on.
Cues cues_of(const SeenSegment& seen, const Rational& frame_rate) {
  if (seen.runs().empty()) return card_cues(seen.segment().card(), frame_rate);
  return seen.runs().size() == 1 ? cues_of_run(seen, frame_rate)
                                 : cues_of_comparison(seen, frame_rate);
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

/// By their frames in the film.
Cues cues_of(const Film& film) {
  Cues cues;
  for (const SeenSegment& seen : seen_segments(film)) {
    for (auto& [frame, text] : cues_of(seen, film.view().frame_rate)) {
      if (cues.empty() || std::prev(cues.end())->second != text) {
        cues[seen.placed.first_seen() + frame] = text;
      }
    }
  }
  return cues;
}

/// @param end  of the last cue
std::string caption_file(const Cues& cues, std::int64_t end, const Rational& frame_rate,
                         CaptionFormat format = CaptionFormat::webvtt) {
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
                        time(next != cues.end() ? next->first : end),
                        is_vtt ? escaped_lines(cue->second) : cue->second);
  }
  return text;
}

/// Those of some frames, numbered from the first of them on.
Cues cues_within(const Cues& cues, const FrameRange& frames) {
  Cues within;
  // The first cue may have begun before.
  for (auto cue = std::prev(cues.upper_bound(frames.first)); cue != cues.upper_bound(frames.last);
       ++cue) {
    within[std::max(cue->first, frames.first) - frames.first] = cue->second;
  }
  return within;
}

}  // namespace

std::vector<Caption> captions_of(const Film& film, const FrameRange& frames) {
  std::vector<Caption> captions;
  for (const auto& [frame, text] : cues_within(cues_of(film), frames))
    captions.push_back({frame, text});
  return captions;
}

std::string captions(const Film& film, CaptionFormat format) {
  return caption_file(cues_of(film), film.frame_count(), film.view().frame_rate, format);
}

std::vector<std::string> shot_captions(const Film& film) {
  const Rational& frame_rate = film.view().frame_rate;
  const std::int64_t second = ceil(frame_rate).get_si();
  const Cues cues = cues_of(film);
  std::vector<std::string> files;
  for (std::size_t i = 0; i < film.segments().size(); ++i) {
    const FrameRange shot = film.shot(i);
    files.push_back(caption_file(cues_within(cues, shot), shot.count() + second, frame_rate));
  }
  return files;
}

std::string chapters(const Film& film) {
  Cues titles;
  for (const SeenSegment& seen : seen_segments(film))
    titles[seen.placed.first_seen()] = name_of(seen);
  return caption_file(titles, film.frame_count(), film.view().frame_rate);
}

}  // namespace piblocks
