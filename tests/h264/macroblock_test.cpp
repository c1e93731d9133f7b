// The choice of mb_type, its bits and its samples.
#include "h264/macroblock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "h264/bit_text.hpp"
#include "h264/random_pictures.hpp"
#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {

constexpr int kDefaultQp = 14;
/// A.3.1
constexpr std::size_t kMostBits = 3200;

/// The largest difference that may stay uncorrected.
int cap(int qp) { return 1 + (1 << qp / 6) / 4; }

Samples flat(int value) {
  Samples samples;
  samples.values.fill(clamped(value));
  return samples;
}

/// Black strokes on white, which have to stay readable.
Samples text(Random& random) {
  Samples samples = flat(235);
  for (auto& value : samples.values) value = random.integer(0, 7) == 0 ? 16 : value;
  return samples;
}

Samples noise(Random& random, int base, int most) {
  Samples samples;
  std::ranges::generate(samples.values,
                        [&] { return clamped(base + random.integer(-most, most)); });
  return samples;
}

Samples random_samples(Random& random) {
  const int base = static_cast<int>(random.integer(0, 255));
  switch (random.integer(0, 3)) {
    case 0:
      return flat(base);
    case 1:
      return text(random);
    default:
      return noise(random, base, 1 << random.integer(0, 8));
  }
}

/// A P macroblock inside the picture, with one value beside it.
MacroblockInput inside(const Samples& source, const Samples& before, int beside) {
  static const MacroblockState skipped;
  MacroblockInput input{};
  input.slice_type = SliceType::p;
  input.source = source;
  input.before = before;
  input.borders.has_above = true;
  input.borders.has_left = true;
  for (Border& border : input.borders.planes) {
    border.above.fill(clamped(beside));
    border.left.fill(clamped(beside));
  }
  input.neighbours = {&skipped, &skipped, &skipped};
  return input;
}

/// Random samples, sometimes nearly equal to those before or beside them.
class RandomInputs {
 public:
  explicit RandomInputs(Random& random) : random_(random) {}

  MacroblockInput next() {
    const Samples source = random_samples(random_);
    MacroblockInput input = inside(source, random_samples(random_), source.values[0]);
    if (random_.integer(0, 1) == 0) input.before = near(source);
    if (random_.integer(0, 3) == 0) input.slice_type = SliceType::i;
    input.borders.has_above = random_.integer(0, 3) > 0;
    input.borders.has_left = random_.integer(0, 3) > 0;
    for (Border& border : input.borders.planes) border.above = changed(border.above);
    for (auto* state : {&above_, &left_}) {
      for (auto& total : state->total_coeff)
        total = static_cast<std::uint8_t>(random_.integer(0, 16));
      for (auto& mode : state->pred_modes) mode = static_cast<std::uint8_t>(random_.integer(0, 2));
    }
    input.neighbours = {input.borders.has_above ? &above_ : nullptr,
                        input.borders.has_left ? &left_ : nullptr};
    return input;
  }

 private:
  template <typename Values>
  Values changed(Values values) {
    const std::int64_t most = random_.integer(0, 1) == 0 ? 0 : 1 << random_.integer(0, 7);
    for (auto& value : values) value = clamped(value + random_.integer(-most, most));
    return values;
  }
  /// All samples by a little, or a few of them by more.
  Samples near(const Samples& samples) {
    Samples result{changed(samples.values)};
    for (auto count = random_.integer(0, 3); count > 0; --count) {
      result.values[static_cast<std::size_t>(random_.integer(0, 383))] = random_.byte();
    }
    return result;
  }

  Random& random_;
  MacroblockState above_;
  MacroblockState left_;
};

/// For every position in a byte at which the macroblock may begin.
std::size_t most_bits(SliceType slice_type, const CodedMacroblock& coded) {
  if (coded.type != MbType::i_pcm) return coded.bits.bit_count();
  std::size_t most = 0;
  for (int start = 0; start < 8; ++start) {
    BitWriter bits;
    bits.put(0, start);
    write_i_pcm(slice_type, coded.samples, bits);
    most = std::max(most, bits.bit_count() - static_cast<std::size_t>(start));
  }
  return most;
}

bool stays_uncorrected(const CodedMacroblock& coded) {
  return coded.type == MbType::p_skip || coded.type == MbType::i_16x16;
}

void for_each_qp(const std::function<void(int, const MacroblockCoder&)>& check) {
  for (int qp = 0; qp <= 51; ++qp) {
    SCOPED_TRACE("QP " + std::to_string(qp));
    MacroblockCoder coder(qp);
    check(qp, coder);
  }
}

TEST(MacroblockCoder, SkipsWhatHasNotChanged) {
  TracedRandom random(1);
  for_each_qp([&](int, const MacroblockCoder& coder) {
    for (const Samples& samples : {flat(200), text(random), noise(random, 128, 255)}) {
      const CodedMacroblock coded = coder.code(inside(samples, samples, 128));
      EXPECT_EQ(coded.type, MbType::p_skip);
      EXPECT_EQ(coded.bits.bit_count(), 0u);
      EXPECT_EQ(coded.samples.values, samples.values);
    }
  });
}

TEST(MacroblockCoder, PredictsWhatEqualsTheRowAboveOrTheColumnLeft) {
  for_each_qp([&](int qp, const MacroblockCoder& coder) {
    for (const bool is_above : {false, true}) {
      MacroblockInput input = inside(flat(0), flat(255), 255);
      for (int plane = 0; plane < 3; ++plane) {
        const int side = side_of(plane);
        Border& border = input.borders.planes[static_cast<std::size_t>(plane)];
        auto& line = is_above ? border.above : border.left;
        for (std::size_t i = 0; i < line.size(); ++i)
          line[i] = clamped(8 * std::int64_t(i) + plane);
        for (int i = 0; i < side * side; ++i) {
          const int at = is_above ? i % side : i / side;
          input.source.plane(plane)[i] = line[static_cast<std::size_t>(at)];
        }
      }
      for (const SliceType slice_type : {SliceType::p, SliceType::i}) {
        input.slice_type = slice_type;
        const CodedMacroblock coded = coder.code(input);
        EXPECT_EQ(coded.type, MbType::i_16x16);
        EXPECT_LE(largest_difference(coded.samples, input.source), qp < 40 ? 0 : cap(qp));
        EXPECT_LE(coded.bits.bit_count(), 16u);
      }
    }
  });
}

TEST(MacroblockCoder, WritesPredictionAsTheTablesSay) {
  MacroblockCoder coder(kDefaultQp);
  MacroblockInput input = inside(flat(90), flat(255), 90);
  // I_16x16 that predicts from above has mb_type 1, and 5 more in P slices; intra_chroma_pred_mode
  // is 0, mb_qp_delta is 0, and the coeff_token of no DC levels is 1.
  EXPECT_EQ(text_of(coder.code(input).bits), without_spaces("00111 1 1 1"));
  input.slice_type = SliceType::i;
  EXPECT_EQ(text_of(coder.code(input).bits), without_spaces("010 1 1 1"));
}

TEST(MacroblockCoder, WritesDifferencesAsTheTablesSay) {
  MacroblockCoder coder(kDefaultQp);
  MacroblockInput input = inside(flat(100), flat(100), 255);
  Random random(5);
  input.source = input.before = noise(random, 100, 90);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      input.source.plane(0)[16 * i + j] = clamped(input.before.plane(0)[16 * i + j] ^ 8);
  }
  const CodedMacroblock coded = coder.code(input);
  ASSERT_EQ(coded.type, MbType::p_l0_16x16);
  // mb_type 0, two vectors of 0, coded_block_pattern 1 with codeNum 2, mb_qp_delta of 0.
  EXPECT_EQ(text_of(coded.bits).substr(0, 7), without_spaces("1 1 1 011 1"));
}

TEST(MacroblockCoder, TakesTheSamplesOfNoiseAtALowQp) {
  TracedRandom random(2);
  MacroblockCoder coder(0);
  for (int i = 0; i < 50; ++i) {
    const MacroblockInput input = inside(noise(random, 128, 255), noise(random, 128, 255), 128);
    const CodedMacroblock coded = coder.code(input);
    EXPECT_EQ(coded.type, MbType::i_pcm);
    EXPECT_EQ(coded.samples.values, input.source.values);
    EXPECT_TRUE(
        std::ranges::all_of(coded.state.total_coeff, [](int total) { return total == 16; }));
  }
}

TEST(MacroblockCoder, WritesSamplesAtAWholeByte) {
  BitWriter bits;
  bits.put(1, 1);
  write_i_pcm(SliceType::i, flat(0x5a), bits);
  // mb_type 25
  EXPECT_EQ(text_of(bits).substr(0, 24), without_spaces("1 000011010 000000 01011010"));
  EXPECT_EQ(bits.bit_count(), 16u + 8 * 384);
}

/// Uncorrected samples stay until the macroblock changes again.
TEST(MacroblockCoder, NeitherTakesTooManyBitsNorLeavesASampleFarOffWithoutCorrection) {
  constexpr int kTimes = 400;
  TracedRandom random(3);
  RandomInputs inputs(random);
  std::array<int, 5> types{};
  for_each_qp([&](int qp, const MacroblockCoder& coder) {
    for (int i = 0; i < kTimes; ++i) {
      const MacroblockInput input = inputs.next();
      const CodedMacroblock coded = coder.code(input);
      ASSERT_LE(most_bits(input.slice_type, coded), kMostBits);
      if (stays_uncorrected(coded)) {
        ASSERT_LE(largest_difference(coded.samples, input.source), cap(qp));
      }
      ++types[static_cast<std::size_t>(coded.type)];
    }
  });
  for (const int count : types) EXPECT_GT(count, 100);  // no type goes untested
  EXPECT_GT(types[std::size_t(MbType::p_skip)] + types[std::size_t(MbType::i_16x16)], 1000);
}

TEST(MacroblockCoder, DoesNotLeaveOneSampleThatIsFurtherOff) {
  for_each_qp([&](int qp, const MacroblockCoder& coder) {
    for (const std::size_t place : {0u, 100u, 255u, 256u, 319u, 320u, 383u}) {
      MacroblockInput input = inside(flat(120), flat(120), 120);
      input.source.values[place] = clamped(120 + cap(qp));
      EXPECT_TRUE(stays_uncorrected(coder.code(input))) << place;
      input.source.values[place] = clamped(120 + cap(qp) + 1);
      EXPECT_FALSE(stays_uncorrected(coder.code(input))) << place;
    }
  });
}

TEST(MacroblockCoder, KeepsTextReadableAtTheDefaultQp) {
  constexpr int kMost = 10;
  TracedRandom random(6);
  RandomInputs inputs(random);
  MacroblockCoder coder(kDefaultQp);
  int largest = 0;
  for (int i = 0; i < 3000; ++i) {
    const MacroblockInput input = inputs.next();
    largest = std::max(largest, largest_difference(coder.code(input).samples, input.source));
  }
  EXPECT_LE(largest, kMost);
}

}  // namespace
}  // namespace piblocks::h264
