// The picture that a scene shows as its logo.
// In: a scene. Out: the decoded file, or nothing.
#pragma once

#include <piblocks/image.hpp>
#include <piblocks/scene.hpp>

#include <memory>

namespace piblocks {

/// Nothing if the scene shows none.
/// @throws UsageError, MediaError if the file cannot be read, or is no PNG.
std::shared_ptr<const Image> read_logo(const Scene& scene);

}  // namespace piblocks
