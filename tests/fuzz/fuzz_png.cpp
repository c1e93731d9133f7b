// PNG files that somebody else has written.
#include <piblocks/error.hpp>

#include "fuzz/input_file.hpp"
#include "media/png/png_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const piblocks::fuzz::InputFile file(data, size);
  try {
    const piblocks::Image image = piblocks::read_png(file.path());
    if (image.words.size() != std::size_t(image.width_px) * std::size_t(image.height_px)) {
      std::abort();
    }
    piblocks::read_png_frame(file.path())->next();
  } catch (const piblocks::Error&) {  // the right answer to most of what comes here
  }
  return 0;
}
