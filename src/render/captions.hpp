// What a film says, for people who cannot hear it or see it well.
// In: a film. Out: captions, chapters.
#pragma once

#include <string>
#include <vector>

#include "render/film.hpp"

namespace piblocks {

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

}  // namespace piblocks
