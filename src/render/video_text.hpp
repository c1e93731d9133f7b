// What a film shows, in words: for its page, and for people who cannot hear it or see it well.
// In: a film. Out: a title, a description in plain English, captions, chapters; what these share:
// names and counts, and the frames that show each segment.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/film.hpp"

namespace piblocks {

/// The scene's own title; without one, the masses and the count. Of a storyboard that of its first
/// part: the heading of a card, or what is compared.
std::string title_of(const Film& film);

/// Of a scene a few sentences: who is there, how they move at first, what the counter says in the
/// end; in which base, if it is not ten; which digits of pi it has counted, if it has counted some;
/// what its diagram proves. Of a storyboard the words of each card, and for each run its title, the
/// bodies, the end of the count and what the diagram proves, in the order of the film.
std::string describe_film(const Film& film);

/// What describe_film() says of each segment of a storyboard.
std::vector<std::string> describe_segments(const Film& film);

/// The attribute of <video> for a film that goes on from its end to its beginning; else empty.
const char* loop_attribute(const Film& film);

/// Of some frames of a film, numbered from the first of them on. A caption ends where the next one
/// begins. In the middle of a fade the captions of the next part begin.
///
/// A card is said as it is written. A run begins with its title, which stays for as long as one
/// reads it. A caption gives the exact count if that stays for a second or more, or is the run's
/// highest. Other captions say "100 collisions or more", from the first frame that counts 1, 10,
/// 100 and so on. Before time 0 captions give the number of collisions until time 0. With the
/// highest count comes what there is time to read: that no more follow, the digits of pi, what the
/// diagram proves. Of compared runs captions give the names, then each count when it is reached.
std::vector<Caption> captions_of(const Film& film, const FrameRange& frames);

/// WebVTT for browsers, SubRip (SRT) for editors and video sites.
enum class CaptionFormat { webvtt, subrip };

/// Those of the whole film. Times are those of frames, rounded up to milliseconds.
std::string captions(const Film& film, CaptionFormat format = CaptionFormat::webvtt);

/// The same as WebVTT for each Film::shot(), in seconds of the shot. The last caption stays as long
/// as the last frame is shown.
std::vector<std::string> shot_captions(const Film& film);

/// WebVTT: the name of each segment, from the middle of its fade on.
std::string chapters(const Film& film);

/// A segment and those of its frames that show it: of a fade each neighbour has one half.
struct SeenSegment {
  const PlacedSegment& placed;
  std::int64_t begin;
  std::int64_t end;

  const FilmSegment& segment() const { return placed.segment; }
  std::span<const FilmRun> runs() const { return segment().runs(); }
  /// What the counter of a run says, frame by frame.
  std::vector<Integer> counts(const FilmRun& run) const;
};

std::vector<SeenSegment> seen_segments(const Film& film);

/// A run, and the collisions that a segment of the film counts.
struct ShownRun {
  const Scene& scene;
  const Log& log;
  Integer at_end;                ///< when the film has come furthest
  std::optional<Integer> total;  ///< of two blocks, and of all that the film shows to the end

  bool is_over() const { return at_end == total; }
  /// Whether `total` stands for infinitely many.
  bool is_endless() const { return piblocks::is_endless(log); }
};

ShownRun shown(const FilmRun& run, const SeenSegment& seen);

/// "1 collision", "1,000 collisions"
std::string collisions(const Integer& count);

/// "31 collisions", "infinitely many collisions", "2 collisions to go until time 0"
std::string last_count(const ShownRun& run);

/// What the count of a run proves once it is over, in words that end with a number, and the number.
struct Proof {
  std::string words;
  std::string number;
};

/// "the first 3 digits of π in base 16, 3.24"; nothing if the run counts no digits of pi.
std::optional<Proof> pi_of(const ShownRun& run);

/// Of the first diagram that proves something about two blocks.
std::optional<Proof> diagram_proof(const ShownRun& run);

/// The title that the scene has, in one line; empty without one.
std::string own_title(const Scene& scene);

/// The same, or the bodies.
std::string name_of(const FilmRun& run);

/// The names of all runs of a segment.
std::string names_of(const SeenSegment& seen, std::string_view between);

/// What a segment is called in a list of them: the words of its card, or the names of its runs; of
/// one run without a title also its diagram's.
std::string name_of(const SeenSegment& seen);

/// The lines of a card.
std::string words_of(const std::vector<std::string>& lines, std::string_view between);

}  // namespace piblocks
