// The picture that a scene shows as its logo.
// In: a scene. Out: the decoded file, or nothing.
#pragma once

#include <piblocks/image.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>

#include <memory>
#include <string>
#include <vector>

namespace piblocks {

/// Nothing if the scene shows none.
/// @throws UsageError, MediaError if the file cannot be read, or is no PNG.
std::shared_ptr<const Image> read_logo(const Scene& scene);

/// The files of all logos of a scene or storyboard.
std::vector<std::string> logos_of(const Script& script);

}  // namespace piblocks
