#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "h264/callers_picture.hpp"
#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {

using Addresses = std::vector<int>;

Addresses addresses_of(const MacroblockSet& set) {
  Addresses addresses;
  for (int address = set.next(0); address >= 0; address = set.next(address + 1)) {
    addresses.push_back(address);
  }
  return addresses;
}

TEST(MacroblockSet, ForgetsAllAtOnce) {
  MacroblockSet set(20, 20);
  add(set, 0, 0, 320, 320);
  set.clear();
  EXPECT_EQ(addresses_of(set), Addresses{});
  add(set, 319, 319, 1, 1);
  EXPECT_EQ(addresses_of(set), Addresses{399});
}

TEST(MacroblockSet, CountsThem) {
  MacroblockSet set(20, 20);
  EXPECT_EQ(set.count(), 0);
  for (const int address : {0, 63, 64, 200, 399, 64}) set.add_one(address);
  EXPECT_EQ(set.count(), 5);
  add(set, 0, 0, 320, 320);
  EXPECT_EQ(set.count(), 400);
}

TEST(MacroblockSet, VisitsWhatIsTouchedOnceAndInOrder) {
  TracedRandom random(6);
  for (int run = 0; run < 200; ++run) {
    const int width_mb = static_cast<int>(random.integer(1, 20));
    const int height_mb = static_cast<int>(random.integer(1, 20));
    MacroblockSet set(width_mb, height_mb);
    std::set<int> touched;
    for (auto count = random.integer(0, 5); count > 0; --count) {
      const int x = static_cast<int>(random.integer(0, 16 * width_mb - 1));
      const int y = static_cast<int>(random.integer(0, 16 * height_mb - 1));
      const int width = static_cast<int>(random.integer(0, 16 * width_mb - x));
      const int height = static_cast<int>(random.integer(0, 16 * height_mb - y));
      add(set, x, y, width, height);
      for (int address = 0; address < width_mb * height_mb; ++address) {
        const int left = 16 * (address % width_mb);
        const int top = 16 * (address / width_mb);
        if (width > 0 && height > 0 && x < left + 16 && left < x + width && y < top + 16 &&
            top < y + height) {
          touched.insert(address);
        }
      }
    }
    EXPECT_EQ(addresses_of(set), Addresses(touched.begin(), touched.end()));
  }
}

}  // namespace
}  // namespace piblocks::h264
