#include "media/libav/codec_choice.hpp"

#include <algorithm>

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {

/// At least two: of two IDR pictures in a row with equal headers a decoder cannot tell that they
/// are two (H.264, 7.4.1.2.4).
int frames_in_a_second(const Rational& frame_rate) {
  constexpr int kMaxFramesPerChunk = 300;
  const Integer frames = floor(frame_rate);
  if (frames > kMaxFramesPerChunk) return kMaxFramesPerChunk;
  return std::max(2, static_cast<int>(frames.get_si()));
}

bool has_option(const AVCodec& codec, const char* name) {
  if (codec.priv_class == nullptr) return false;
  const AVClass* options = codec.priv_class;
  return av_opt_find(&options, name, nullptr, 0, AV_OPT_SEARCH_FAKE_OBJ) != nullptr;
}

}  // namespace piblocks
