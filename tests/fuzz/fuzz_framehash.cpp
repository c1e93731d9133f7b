// Files of frame hashes that somebody else has written.
#include <piblocks/error.hpp>

#include "fuzz/input_file.hpp"
#include "golden/rows.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const piblocks::fuzz::InputFile file(data, size);
  try {
    piblocks::read_framehash(file.path());
  } catch (const piblocks::Error&) {  // the right answer to most of what comes here
  }
  return 0;
}
