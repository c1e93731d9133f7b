// Random inputs for property tests, the same in every run with the same PIBLOCKS_SEED.
// In: a seed of the test's own, which the environment variable PIBLOCKS_SEED moves (default: 0).
// Out: numbers, and a line that says how to repeat the run: SCOPED_TRACE(random.trace()).
#pragma once

#include <piblocks/exact.hpp>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace piblocks {

/// The number of cases to try. PIBLOCKS_STRESS=N multiplies those of an ordinary run by N.
inline std::int64_t many(std::int64_t ordinary) {
  const char* factor = std::getenv("PIBLOCKS_STRESS");
  return factor == nullptr ? ordinary : ordinary * std::atoll(factor);
}

class Random {
 public:
  explicit Random(std::uint64_t own_seed) : engine_(own_seed + kFarApart * run_seed()) {}

  static std::string trace() { return "repeat with PIBLOCKS_SEED=" + std::to_string(run_seed()); }

  /// An integer of [first, last], each nearly equally likely.
  std::int64_t integer(std::int64_t first, std::int64_t last) {
    const auto span = static_cast<std::uint64_t>(last - first) + 1;
    return first + static_cast<std::int64_t>(engine_() % span);
  }

  std::uint8_t byte() { return static_cast<std::uint8_t>(engine_() % 256); }

  /// A double of [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

  /// A multiple of 1/denominator in [low, high].
  Rational rational(std::int64_t low, std::int64_t high, std::int64_t denominator) {
    Rational value(Integer(integer(low * denominator, high * denominator)), Integer(denominator));
    value.canonicalize();
    return value;
  }

 private:
  /// Seeds of tests are small numbers that often follow each other.
  static constexpr std::uint64_t kFarApart = 0x9e3779b97f4a7c15;

  static std::uint64_t run_seed() {
    const char* text = std::getenv("PIBLOCKS_SEED");
    return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
  }

  std::mt19937_64 engine_;
};

}  // namespace piblocks
