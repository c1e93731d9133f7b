// The whole library, except event_simulator.hpp, which needs Eigen.
// In: a scene, from a file or filled in by hand. Out: videos, pictures, counts, states,
// comparisons.
#pragma once

#include <piblocks/compare.hpp>
#include <piblocks/log.hpp>
#include <piblocks/render.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>
#include <piblocks/system.hpp>

// More: two blocks and pi, exact numbers, instants, collisions of one's own, pixels, encoders.
#include <piblocks/contact.hpp>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/image.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/two_blocks.hpp>
#include <piblocks/version.hpp>
