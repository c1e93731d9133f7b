// The least of many entries, after one of them has changed.
// In: a comparison of entries by their numbers. Out: the least entry, in O(log N).
#pragma once

#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace piblocks {

/// @tparam Less  less(a, b): whether entry a goes before entry b. It may say no for equal entries.
template <typename Less>
class Tournament {
 public:
  Tournament(std::size_t entries, Less less)
      : less_(std::move(less)), leaves_(std::bit_ceil(entries)), winners_(2 * leaves_, kNobody) {
    for (std::size_t entry = 0; entry < entries; ++entry) winners_[leaves_ + entry] = entry;
    replay_all();
  }

  /// The least entry, if there is one.
  std::size_t winner() const { return winners_[1]; }

  /// To be called after the entry has changed.
  void replay(std::size_t entry) {
    for (std::size_t node = (leaves_ + entry) / 2; node > 0; node /= 2) play(node);
  }
  /// The same for all entries, in O(N).
  void replay_all() {
    for (std::size_t node = leaves_ - 1; node > 0; --node) play(node);
  }

 private:
  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

  void play(std::size_t node) {
    const std::size_t a = winners_[2 * node];
    const std::size_t b = winners_[2 * node + 1];
    winners_[node] = b == kNobody || !less_(b, a) ? a : b;
  }

  Less less_;
  std::size_t leaves_;                // a power of two
  std::vector<std::size_t> winners_;  // of node n the children are 2n and 2n + 1; leaves come last
};

}  // namespace piblocks
