// What a film shows, in words: for its page, and for people who cannot see or hear it.
// In: a film. Out: a title, a description in plain English, captions.
#pragma once

#include <string>
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

/// A caption ends where the next one begins, the last one with the film. In the middle of a fade
/// the captions of the next part begin.
///
/// A card is said as it is written. A run begins with its title, which stays for as long as one
/// reads it. A caption gives the exact count if that stays for a second or more, or is the run's
/// highest. Other captions say "100 collisions or more", from the first frame that counts 1, 10,
/// 100 and so on. Before time 0 captions give the number of collisions until time 0. With the
/// highest count comes what there is time to read: that no more follow, the digits of pi, what the
/// diagram proves. Of compared runs captions give the names, then each count when it is reached.
std::vector<Caption> captions_of(const Film& film);

/// WebVTT for browsers, SubRip (SRT) for editors and video sites.
enum class CaptionFormat { webvtt, subrip };

/// Those captions as a file. Times are those of frames, rounded up to milliseconds.
std::string captions(const Film& film, CaptionFormat format = CaptionFormat::webvtt);

/// The captions as an address that has them in it: browsers load none from beside a page that is
/// opened from a folder.
std::string captions_address(const Film& film);

/// The attribute of <video> for a film that goes on from its end to its beginning; else empty.
const char* loop_attribute(const Film& film);

}  // namespace piblocks
