// Parts of a rendering: read whole, and joined.
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include "fuzz/input_file.hpp"
#include "media/output/shard_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const piblocks::fuzz::InputFile file(data, size);
  try {
    piblocks::ShardReader reader(file.path());
    while (reader.next()) {
    }
  } catch (const piblocks::Error&) {  // the right answer to most of what comes here
  }
  try {
    piblocks::join({file.path()}, "null");
  } catch (const piblocks::Error&) {
  }
  return 0;
}
