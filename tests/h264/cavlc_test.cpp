// Transform coefficients in variable-length codes, against a decoder by ITU-T H.264, 9.2, that
// shares the tables of codes and nothing else.
#include "h264/cavlc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "h264/bit_text.hpp"
#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {

using BlockLevels = std::vector<std::int16_t>;

std::string text_of(const Code& code) {
  std::string text;
  for (int i = code.length - 1; i >= 0; --i) text += (code.bits >> i & 1) != 0 ? '1' : '0';
  return text;
}

/// A column or a row of a table in the standard. A code that does not exist is empty.
using Texts = std::vector<std::string>;

template <typename Row>
Texts texts_of(const Row& row) {
  Texts texts;
  for (const Code& code : row) texts.push_back(text_of(code));
  return texts;
}

/// The place of TotalCoeff and TrailingOnes in the lists below.
std::size_t token_place(std::size_t total, std::size_t trailing_ones) {
  return 4 * total + trailing_ones;
}

template <typename Column>
Texts token_texts(const Column& column) {
  Texts all;
  for (const TokenRow& row : column) {
    const Texts texts = texts_of(row);
    all.insert(all.end(), texts.begin(), texts.end());
  }
  return all;
}

/// Table 9-5's last column, by its rule.
Texts long_token_texts() {
  Texts all(std::size_t{4} * 17);
  all[0] = "000011";
  for (std::size_t total = 1; total <= 16; ++total) {
    for (std::size_t ones = 0; ones <= std::min<std::size_t>(total, 3); ++ones) {
      const std::size_t value = 4 * (total - 1) + ones;
      std::string& text = all[token_place(total, ones)];
      for (int i = 5; i >= 0; --i) text += (value >> i & 1) != 0 ? '1' : '0';
    }
  }
  return all;
}

/// Codes that begin with other codes, missing codes, and surplus codes.
Texts faults_of(const Texts& codes, const std::set<std::size_t>& places) {
  Texts faults;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (codes[i].empty() == places.contains(i)) faults.push_back("place " + std::to_string(i));
    for (std::size_t j = 0; j < codes.size(); ++j) {
      if (i == j || codes[i].empty() || !codes[j].starts_with(codes[i])) continue;
      faults.push_back(codes[i] + " begins " + codes[j]);
    }
  }
  return faults;
}

/// How many sequences of `length` bits, which is that of the longest code, begin with no code.
std::size_t unused_sequences(const Texts& codes, std::size_t length) {
  std::size_t unused = std::size_t{1} << length;
  for (const std::string& code : codes) {
    if (!code.empty()) unused -= std::size_t{1} << (length - code.size());
  }
  return unused;
}

std::set<std::size_t> first_places(std::size_t count) {
  std::set<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i) places.insert(i);
  return places;
}

std::set<std::size_t> token_places(std::size_t most) {
  std::set<std::size_t> places;
  for (std::size_t total = 0; total <= most; ++total) {
    for (std::size_t ones = 0; ones <= std::min<std::size_t>(total, 3); ++ones) {
      places.insert(token_place(total, ones));
    }
  }
  return places;
}

TEST(CavlcTables, TokensArePrefixCodes) {
  const Texts few = token_texts(kCoefficientTokens[0]);
  const Texts some = token_texts(kCoefficientTokens[1]);
  const Texts many = token_texts(kCoefficientTokens[2]);
  const Texts chroma_dc = token_texts(kChromaDcTokens);
  for (const Texts* texts : {&few, &some, &many}) {
    EXPECT_EQ(faults_of(*texts, token_places(16)), Texts{});
  }
  EXPECT_EQ(faults_of(chroma_dc, token_places(4)), Texts{});
  // Only the codes of zeros alone, and one more in the longer columns, are left out.
  EXPECT_EQ(unused_sequences(few, 16), 2u);
  EXPECT_EQ(unused_sequences(some, 14), 2u);
  EXPECT_EQ(unused_sequences(many, 10), 1u);
  EXPECT_EQ(unused_sequences(chroma_dc, 8), 0u);
}

TEST(CavlcTables, ZerosArePrefixCodes) {
  for (std::size_t total = 1; total <= 15; ++total) {
    const Texts texts = texts_of(kTotalZeros[total - 1]);
    EXPECT_EQ(faults_of(texts, first_places(17 - total)), Texts{}) << total;
    EXPECT_EQ(unused_sequences(texts, 9), total == 1 ? 1u : 0u) << total;
  }
  for (std::size_t total = 1; total <= 3; ++total) {
    const Texts texts = texts_of(kChromaDcTotalZeros[total - 1]);
    EXPECT_EQ(faults_of(texts, first_places(5 - total)), Texts{}) << total;
    EXPECT_EQ(unused_sequences(texts, 3), 0u) << total;
  }
}

TEST(CavlcTables, RunsArePrefixCodes) {
  for (std::size_t zeros_left = 1; zeros_left <= 7; ++zeros_left) {
    const Texts texts = texts_of(kRunsBefore[zeros_left - 1]);
    const std::size_t count = zeros_left <= 6 ? zeros_left + 1 : 15;
    EXPECT_EQ(faults_of(texts, first_places(count)), Texts{}) << zeros_left;
    EXPECT_EQ(unused_sequences(texts, 11), zeros_left <= 6 ? 0u : 1u) << zeros_left;
  }
}

/// Reads one block, 9.2.1 to 9.2.4.
class Decoder {
 public:
  explicit Decoder(std::string_view bits) : rest_(bits) {}

  BlockLevels read_block(std::size_t size, int context);
  std::string_view rest() const { return rest_; }

 private:
  bool bit() {
    if (rest_.empty()) throw std::runtime_error("the bits have ended");
    const bool one = rest_.front() == '1';
    rest_.remove_prefix(1);
    return one;
  }
  int number(int count) {
    int value = 0;
    for (; count > 0; --count) value = 2 * value + (bit() ? 1 : 0);
    return value;
  }
  std::size_t code_of(const Texts& codes) {
    std::string seen;
    while (true) {
      seen += bit() ? '1' : '0';
      const auto place = std::find(codes.begin(), codes.end(), seen);
      if (place != codes.end()) return std::size_t(place - codes.begin());
      if (seen.size() > 16) throw std::runtime_error("no such code");
    }
  }
  std::size_t token(int context);
  int level_code(int suffix_length);
  std::vector<int> levels(std::size_t total, std::size_t trailing_ones);

  std::string_view rest_;
};

std::size_t Decoder::token(int context) {
  if (context == -1) return code_of(token_texts(kChromaDcTokens));
  if (context >= 8) return code_of(long_token_texts());
  const std::size_t column = context >= 4 ? 2 : std::size_t(context / 2);
  return code_of(token_texts(kCoefficientTokens.at(column)));
}

/// levelCode after steps 1 to 5 of 9.2.2.1.
int Decoder::level_code(int suffix_length) {
  int prefix = 0;
  while (!bit()) ++prefix;
  if (prefix > 15) throw std::runtime_error("a long escape");
  int suffix_size = suffix_length;
  if (prefix == 14 && suffix_length == 0) suffix_size = 4;
  if (prefix == 15) suffix_size = 12;
  int code = (prefix << suffix_length) + number(suffix_size);
  if (prefix == 15 && suffix_length == 0) code += 15;
  return code;
}

std::vector<int> Decoder::levels(std::size_t total, std::size_t trailing_ones) {
  std::vector<int> values;
  int suffix_length = total > 10 && trailing_ones < 3 ? 1 : 0;
  while (values.size() < total) {
    if (values.size() < trailing_ones) {
      values.push_back(bit() ? -1 : 1);
      continue;
    }
    int code = level_code(suffix_length);
    if (values.size() == trailing_ones && trailing_ones < 3) code += 2;
    values.push_back(code % 2 == 0 ? (code + 2) / 2 : (-code - 1) / 2);
    if (suffix_length == 0) suffix_length = 1;
    constexpr std::array kLimits = {0, 3, 6, 12, 24, 48};
    if (suffix_length < 6 && std::abs(values.back()) > kLimits.at(std::size_t(suffix_length))) {
      ++suffix_length;
    }
  }
  return values;
}

BlockLevels Decoder::read_block(std::size_t size, int context) {
  const std::size_t found = token(context);
  const std::size_t total = found / 4;
  BlockLevels block(size);
  if (total == 0) return block;
  const std::vector<int> values = levels(total, found % 4);
  std::size_t zeros_left = 0;
  if (total < size) {
    zeros_left = code_of(context == -1 ? texts_of(kChromaDcTotalZeros.at(total - 1))
                                       : texts_of(kTotalZeros.at(total - 1)));
  }
  std::size_t place = total + zeros_left;
  for (std::size_t i = 0; i < total; ++i) {
    block.at(--place) = static_cast<std::int16_t>(values.at(i));
    if (zeros_left == 0 || i == total - 1) continue;
    const std::size_t run =
        code_of(texts_of(kRunsBefore.at(std::min<std::size_t>(zeros_left, 7) - 1)));
    place -= run;
    zeros_left -= run;
  }
  return block;
}

/// The bits of a block that starts with `levels`, or "refused".
std::string coded(BlockLevels levels, int context, std::size_t size = 16) {
  levels.resize(size);
  BitWriter bits;
  const auto total = static_cast<int>(size - std::size_t(std::ranges::count(levels, 0)));
  const bool fits = write_levels(levels, total, context, bits);
  return fits ? text_of(bits) : "refused";
}

// The first three are in I. Richardson, "H.264 and MPEG-4 Video Compression", 6.4.12. Spaces stand
// between a token, the signs, each level, the zeros in all, and each run of zeros.
TEST(Cavlc, WritesBlocksDoneByHand) {
  EXPECT_EQ(coded({0, 3, 0, 1, -1, -1, 0, 1}, 0),
            without_spaces("0000100 011 1 0010 111 10 1 1 01"));
  EXPECT_EQ(coded({-2, 4, 3, -3, 0, 0, -1}, 0),
            without_spaces("0000000110 1 0001 0010 00010 111 0011 00"));
  EXPECT_EQ(coded({0, 0, 0, 1, 0, 1, 0, 0, 0, -1}, 0), without_spaces("00011 100 011 100 10"));
  EXPECT_EQ(coded({-2, 0, 0, 1}, kChromaDc, 4), without_spaces("000110 0 01 00 00"));
  EXPECT_EQ(coded({1, -1, 1, 1}, kChromaDc, 4), without_spaces("0000000 001 1"));
  // No zeros in all where a block is full. After the first 1 each level has a suffix.
  EXPECT_EQ(coded(BlockLevels(15, 1), 8, 15),
            without_spaces("111011 000 1 10 10 10 10 10 10 10 10 10 10 10"));
}

TEST(Cavlc, WritesThatThereAreNoLevels) {
  EXPECT_EQ(coded({}, 0), "1");
  EXPECT_EQ(coded({}, 2), "11");
  EXPECT_EQ(coded({}, 4, 15), "1111");
  EXPECT_EQ(coded({}, 8), "000011");
  EXPECT_EQ(coded({}, 16), "000011");
  EXPECT_EQ(coded({}, kChromaDc, 4), "01");
}

/// Sizes of all kinds: many of 1, few that need an escape or have no code.
std::int16_t random_level(Random& random) {
  constexpr std::array kLimits = {1, 1, 3, 20, 100, 2063, 2600, 32767};
  const std::int64_t limit = kLimits.at(std::size_t(random.integer(0, 7)));
  return static_cast<std::int16_t>(random.integer(-limit, limit));
}

BlockLevels random_block(Random& random, std::size_t size) {
  BlockLevels levels(size);
  const std::int64_t percentage = random.integer(0, 100);
  const bool is_small = random.integer(0, 1) == 0;
  for (std::int16_t& level : levels) {
    if (random.integer(1, 100) > percentage) continue;
    level = is_small ? static_cast<std::int16_t>(random.integer(-2, 2)) : random_level(random);
  }
  return levels;
}

void expect_round_trip(const BlockLevels& levels, int context) {
  const std::string bits = coded(levels, context, levels.size());
  if (bits == "refused") {
    const auto is_large = [](std::int16_t level) { return std::abs(level) > 2063; };
    EXPECT_TRUE(std::ranges::any_of(levels, is_large));
    return;
  }
  const std::string more = "10110";
  const std::string stream = bits + more;
  Decoder decoder(stream);
  EXPECT_EQ(decoder.read_block(levels.size(), context), levels);
  EXPECT_EQ(decoder.rest(), more);
}

TEST(Cavlc, BlocksComeBack) {
  TracedRandom random(264);
  for (int i = 0; i < 1500; ++i) {
    for (int context = 0; context <= 16; ++context) {
      expect_round_trip(random_block(random, random.integer(0, 1) == 0 ? 15 : 16), context);
    }
    for (int j = 0; j < 4; ++j) expect_round_trip(random_block(random, 4), kChromaDc);
    if (HasFailure()) return;
  }
}

/// Every place of zeros among trailing ones.
TEST(Cavlc, AllRunsComeBack) {
  for (const std::size_t size : {4u, 15u, 16u}) {
    for (std::uint32_t pattern = 0; pattern < 1U << size; ++pattern) {
      if (size > 4 && pattern % 5 != 0) continue;
      BlockLevels levels(size);
      for (std::size_t i = 0; i < size; ++i) levels[i] = pattern >> i & 1;
      expect_round_trip(levels, size == 4 ? kChromaDc : 8);
    }
    if (HasFailure()) return;
  }
}

/// Levels that are written before the one in question, and the largest that it may be.
struct Limit {
  BlockLevels before;
  int largest;
};

/// levelCode is at most 30 + 4095 without a suffix, and (15 << suffixLength) + 4095 with one.
TEST(Cavlc, RefusesWhatTheEscapeCannotHold) {
  const std::vector<Limit> limits = {{{}, 2064},      // no suffix; 1 and -1 are not among its codes
                                     {{1, 1}, 2064},  // the same
                                     {{1, 1, 1}, 2063},                       // no suffix
                                     {{1, 1, 1, 1}, 2063},                    // suffixes of 1 bit
                                     {{2, 1, 1, 1, 1, 1, 1, 1, 1, 1}, 2063},  // the same
                                     {{4}, 2078},                             // 2 bits
                                     {{4, 7}, 2108},
                                     {{4, 7, 13}, 2168},
                                     {{4, 7, 13, 25}, 2288},
                                     {{4, 7, 13, 25, 49}, 2528},  // 6 bits
                                     {{4, 7, 13, 25, 49, 1000}, 2528}};
  for (const auto& [before, largest] : limits) {
    for (const int sign : {1, -1}) {
      BlockLevels levels(before.rbegin(), before.rend());
      levels.insert(levels.begin(), static_cast<std::int16_t>(sign * largest));
      const std::string bits = coded(levels, 0);
      ASSERT_NE(bits, "refused") << largest;
      levels.resize(16);
      EXPECT_EQ(Decoder(bits).read_block(16, 0), levels);
      levels[0] = static_cast<std::int16_t>(sign * (largest + 1));
      EXPECT_EQ(coded(levels, 0), "refused") << largest;
    }
  }
  EXPECT_EQ(coded({-32768}, 0), "refused");
  EXPECT_EQ(coded({32767}, 0), "refused");
}

}  // namespace
}  // namespace piblocks::h264
