// Short texts of the command line: numbers, instants, ends of a span, patterns of file names.
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/scene.hpp>

#include <cstdlib>
#include <string>

#include "media/output/frame_pattern.hpp"

namespace {

template <typename Parse>
void try_to(const Parse& parse) {
  try {
    parse();
  } catch (const piblocks::Error&) {  // the right answer to most of what comes here
  }
}

/// Whatever a pattern is, it makes one name for a number, without a folder.
void check_name(const piblocks::FramePattern& pattern) {
  const std::string name = pattern.name(7);
  if (name.find('7') == std::string::npos || name.find('/') != std::string::npos) std::abort();
  if (name == pattern.name(8)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace piblocks;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try_to([&] {
    const Rational number = parse_rational(text);
    constexpr std::size_t kLong = 10'000;  // bits; printing millions takes its time
    const bool is_short = mpz_sizeinbase(number.get_num_mpz_t(), 2) < kLong &&
                          mpz_sizeinbase(number.get_den_mpz_t(), 2) < kLong;
    if (is_short && parse_rational(number.get_str()) != number) std::abort();
  });
  try_to([&] {
    const Instant instant = parse_instant(text);
    constexpr std::size_t kLong = 10'000;  // characters
    const std::string exact = exact_text(instant);
    if (exact.size() < kLong && parse_instant(exact) != instant) std::abort();
  });
  try_to([&] { check_name(FramePattern(text)); });
  return 0;
}
