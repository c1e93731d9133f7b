// NAL units, against the rules of ITU-T H.264, 7.4.1 and annex B.
#include "h264/nal_unit.hpp"

#include <gtest/gtest.h>

#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes unit_of(const Bytes& rbsp, UnitType type = UnitType::slice, int nal_ref_idc = 2) {
  Bytes stream;
  append_unit(type, nal_ref_idc, rbsp, stream);
  return stream;
}

/// The bytes of a unit behind its header.
Bytes payload_of(const Bytes& rbsp) {
  const Bytes stream = unit_of(rbsp);
  return {stream.begin() + 5, stream.end()};
}

/// The bytes of the only unit.
Bytes read_back(const Bytes& stream) {
  const std::vector<Unit> units = read_units(stream);
  EXPECT_EQ(units.size(), 1u);
  return units.empty() ? Bytes{} : units.front().rbsp;
}

TEST(NalUnit, BeginsWithStartCodeAndHeader) {
  EXPECT_EQ(unit_of({7}, UnitType::sequence_parameters, 3), (Bytes{0, 0, 0, 1, 0x67, 7}));
  EXPECT_EQ(unit_of({7}, UnitType::slice, 2), (Bytes{0, 0, 0, 1, 0x41, 7}));
  EXPECT_EQ(unit_of({7}, UnitType::sei, 0), (Bytes{0, 0, 0, 1, 0x06, 7}));
}

TEST(NalUnit, PreventsWhatStartCodesConsistOf) {
  EXPECT_EQ(payload_of({0, 0, 0, 9}), (Bytes{0, 0, 3, 0, 9}));
  EXPECT_EQ(payload_of({0, 0, 1}), (Bytes{0, 0, 3, 1}));
  EXPECT_EQ(payload_of({0, 0, 2}), (Bytes{0, 0, 3, 2}));
  EXPECT_EQ(payload_of({0, 0, 3}), (Bytes{0, 0, 3, 3}));
  EXPECT_EQ(payload_of({0, 0, 4}), (Bytes{0, 0, 4}));
  EXPECT_EQ(payload_of({0, 1, 0, 2, 0}), (Bytes{0, 1, 0, 2, 0, 3}));
  EXPECT_EQ(payload_of({0, 0, 0, 0, 0, 1}), (Bytes{0, 0, 3, 0, 0, 3, 0, 1}));
}

/// cabac_zero_words may follow the last bit of an RBSP.
TEST(NalUnit, DoesNotEndInZeros) {
  EXPECT_EQ(payload_of({8, 0, 0}), (Bytes{8, 0, 0, 3}));
  EXPECT_EQ(payload_of({8, 0, 0, 0, 0}), (Bytes{8, 0, 0, 3, 0, 0, 3}));
  EXPECT_EQ(read_back(unit_of({8, 0, 0})), (Bytes{8, 0, 0}));
  EXPECT_EQ(read_back(unit_of({8, 0, 0, 0, 0})), (Bytes{8, 0, 0, 0, 0}));
}

TEST(NalUnit, ReadsStartCodesOfThreeAndFourBytes) {
  // Zeros before the first start code and after any unit; a unit of no bytes is none.
  const Bytes stream = {0, 0, 0, 0, 1, 0x67, 1, 2, 0,    0, 1, 0x68, 3, 0, 0, 0, 0, 1,
                        0, 0, 1, 0, 0, 0,    0, 1, 0x65, 0, 0, 3,    1, 4, 0, 0, 0};
  const std::vector<Unit> units = read_units(stream);
  ASSERT_EQ(units.size(), 3u);
  EXPECT_EQ(units[0].type, 7);
  EXPECT_EQ(units[0].rbsp, (Bytes{1, 2}));
  EXPECT_EQ(units[1].type, 8);
  EXPECT_EQ(units[1].rbsp, (Bytes{3}));
  EXPECT_EQ(units[2].type, 5);
  EXPECT_EQ(units[2].rbsp, (Bytes{0, 0, 1, 4}));
}

TEST(NalUnit, FindsNothingWhereThereIsNoUnit) {
  for (const Bytes& stream :
       {Bytes{}, Bytes{0}, Bytes{0, 0, 1}, Bytes{0, 0, 0, 1}, Bytes{0, 0, 2}, Bytes{0, 0, 0, 0},
        Bytes{9, 9, 9, 9}, Bytes{9, 0, 1, 9}, Bytes{0, 9, 1, 9}}) {
    EXPECT_TRUE(read_units(stream).empty());
  }
}

TEST(NalUnit, DropsOnlyUserDataBeforeAnotherUnit) {
  const auto rest_of = [](const Bytes& stream) {
    const auto rest = without_user_data(stream);
    return Bytes(rest.begin(), rest.end());
  };
  const Bytes slice = {0, 0, 1, 0x65, 9};
  EXPECT_EQ(rest_of({0, 0, 0, 1, 6, 5, 7, 7, 0, 0, 1, 0x65, 9}), slice);
  EXPECT_EQ(rest_of({0, 0, 1, 6, 5, 7, 0, 0, 1, 0x65, 9}), slice);
  for (const Bytes& kept : {slice, Bytes{}, Bytes{0, 0, 1, 6}, Bytes{0, 0, 1, 6, 5, 7},
                            Bytes{0, 0, 1, 6, 1, 7, 0, 0, 1, 0x65, 9}}) {
    EXPECT_EQ(rest_of(kept), kept);
  }
}

/// Bytes that are often zero, the last one never.
Bytes random_rbsp(Random& random) {
  const std::int64_t largest = random.integer(0, 1) == 0 ? 4 : 255;
  Bytes bytes;
  for (std::int64_t left = random.integer(1, 60); left > 0; --left) {
    const bool is_zero = random.integer(0, 2) > 0;
    bytes.push_back(static_cast<std::uint8_t>(is_zero ? 0 : random.integer(0, largest)));
  }
  if (bytes.back() == 0) bytes.back() = 0x80;
  return bytes;
}

bool has_forbidden_bytes(const Bytes& payload) {
  for (std::size_t i = 2; i < payload.size(); ++i) {
    if (payload[i - 2] == 0 && payload[i - 1] == 0 && payload[i] < 3) return true;
  }
  return payload.back() == 0;
}

TEST(NalUnit, UnitsComeBack) {
  TracedRandom random(7);
  for (int i = 0; i < 5000 && !HasFailure(); ++i) {
    std::vector<Bytes> written;
    Bytes stream;
    for (std::int64_t count = random.integer(1, 4); count > 0; --count) {
      written.push_back(random_rbsp(random));
      EXPECT_FALSE(has_forbidden_bytes(payload_of(written.back())));
      append_unit(UnitType::idr_slice, 1, written.back(), stream);
      stream.resize(stream.size() + std::size_t(random.integer(0, 3)));
    }
    const std::vector<Unit> units = read_units(stream);
    ASSERT_EQ(units.size(), written.size());
    for (std::size_t j = 0; j < units.size(); ++j) {
      EXPECT_EQ(units[j].type, 5);
      EXPECT_EQ(units[j].rbsp, written[j]);
    }
  }
}

}  // namespace
}  // namespace piblocks::h264
