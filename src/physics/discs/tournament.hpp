// The soonest of one event for each disc.
// In: keys, replaced one by one. Out: whose key is least, in O(1); a new key costs O(log N).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/discs/disc.hpp"

namespace piblocks::discs {

/// Events are in the order of times, simultaneous ones in that of ranks.
struct EventKey {
  double time = kNever;
  std::uint64_t rank = 0;

  bool before(const EventKey& other) const {
    // Without branches: which of two discs is sooner cannot be guessed.
    const int sooner = static_cast<int>(time < other.time);
    const int tied = static_cast<int>(time == other.time) & static_cast<int>(rank < other.rank);
    return (sooner | tied) != 0;
  }
};

/// A binary tree whose leaves are discs. Each inner node names the disc of its subtree whose key is
/// least, so a new key changes at most the nodes above it.
class Tournament {
 public:
  explicit Tournament(std::size_t size)
      : leaves_(std::bit_ceil(std::max<std::size_t>(size, 1))),
        keys_(leaves_),
        nodes_(2 * leaves_) {
    for (std::size_t leaf = 0; leaf < leaves_; ++leaf) {
      nodes_[leaves_ + leaf] = static_cast<std::uint32_t>(leaf);
    }
    for (std::size_t node = leaves_; --node > 0;) nodes_[node] = winner_below(node);
  }

  std::uint32_t first() const { return nodes_[1]; }
  const EventKey& key(std::uint32_t disc) const { return keys_[disc]; }

  void set(std::uint32_t disc, const EventKey& key) {
    keys_[disc] = key;
    for (std::size_t node = (leaves_ + disc) / 2; node > 0; node /= 2) {
      const std::uint32_t winner = winner_below(node);
      // Neither the old key nor the new one has a say further up.
      if (winner != disc && winner == nodes_[node]) return;
      nodes_[node] = winner;
    }
  }

 private:
  std::uint32_t winner_below(std::size_t node) const {
    const std::uint32_t left = nodes_[2 * node];
    const std::uint32_t right = nodes_[2 * node + 1];
    return keys_[right].before(keys_[left]) ? right : left;
  }

  std::size_t leaves_;
  std::vector<EventKey> keys_;
  std::vector<std::uint32_t> nodes_;
};

}  // namespace piblocks::discs
