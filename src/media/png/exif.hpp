// How players turn a picture that has an eXIf chunk (PNG specification, third edition, 11.3.4.5).
#pragma once

#include <string>

#include "media/output/bytes.hpp"

namespace piblocks {

/// FrameReader::presentation() of a picture with these Exif data: what its tag Orientation says
/// (Exif 2.32, 4.6.4). Empty if it says nothing that can be understood.
std::string presentation_by_exif(ByteSpan exif);

}  // namespace piblocks
