// Videos that somebody else has made. libav itself is not instrumented.
#include <piblocks/error.hpp>

#include "fuzz/input_file.hpp"
#include "media/libav/av.hpp"
#include "media/libav/av_module.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int kFrames = 4;
  const piblocks::fuzz::InputFile file(data, size);
  piblocks::silence_av();
  try {
    const auto reader = piblocks::decode_video_file(file.path());
    for (int i = 0; i < kFrames && reader->next(); ++i) {
      reader->samples();
      reader->rgb();
    }
  } catch (const piblocks::Error&) {  // the right answer to most of what comes here
  }
  return 0;
}
