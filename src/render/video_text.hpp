// What a film shows, in words: for its page, and for people who cannot see or hear it.
// In: a film. Out: a title, a description in plain English.
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

/// What describe_film() says of each segment of a storyboard.
std::vector<std::string> describe_segments(const Film& film);

/// The attribute of <video> for a film that goes on from its end to its beginning; else empty.
const char* loop_attribute(const Film& film);

}  // namespace piblocks
