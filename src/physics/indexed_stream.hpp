// A log that knows its collisions one by one, as a stream.
// In: a log and a range of indices. Out: the log's own answers, in batches.
#pragma once

#include <piblocks/run.hpp>

#include <utility>

namespace piblocks {

class IndexedStream final : public CollisionStream {
 public:
  IndexedStream(const CollisionLog& log, Integer first, Integer last)
      : log_(log), next_(std::move(first)), last_(std::move(last)) {}

  bool read(CollisionBatch& batch) override {
    batch.first = next_;
    for (batch.size = 0; batch.size < CollisionBatch::kCapacity && next_ <= last_; ++batch.size) {
      const Collision c = log_.at(next_);
      batch.kind[batch.size] = c.kind;
      batch.time_hi[batch.size] = c.time.hi;
      batch.time_lo[batch.size] = c.time.lo;
      batch.blue_position[batch.size] = c.blue.position;
      batch.blue_velocity[batch.size] = c.blue.velocity;
      batch.red_position[batch.size] = c.red.position;
      batch.red_velocity[batch.size] = c.red.velocity;
      ++next_;
    }
    return batch.size > 0;
  }

 private:
  const CollisionLog& log_;
  Integer next_;
  Integer last_;
};

}  // namespace piblocks
