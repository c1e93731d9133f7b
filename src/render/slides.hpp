// Ways to show the videos of a bundle in a lecture.
// In: a film, and the name of its video. Out: texts for LaTeX beamer, reveal.js and Impress.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "render/film.hpp"

namespace piblocks {

/// The name of a shot's file: "why-pi-01.mp4" for "why-pi.mp4".
/// @param number  from 1 on
std::string shot_name(const std::string& video, std::size_t number, std::string_view ending);

/// How the text for beamer begins.
std::string_view beginning_of_latex();

/// Of a film of one segment a frame's content; of others a frame for each shot. It names all files
/// of the shots.
std::string latex_slides(const Film& film, const std::string& video);

/// A <section> of reveal.js for the film, or for each shot. The poster of a shot is the last
/// picture of the shot before, so that nothing flashes.
std::string reveal_slides(const Film& film, const std::string& video);

/// A flat OpenDocument presentation with a slide for each shot.
std::string impress_slides(const Film& film, const std::string& video);

}  // namespace piblocks
