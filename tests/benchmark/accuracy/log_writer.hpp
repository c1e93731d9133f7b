// Where a method puts the events of a whole log.
// In: event after event. Out: the wanted ones, exactly; the others have been written to memory
// that stays in the cache, so that no compiler leaves their computation out.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "accuracy/deadline.hpp"
#include "accuracy/method.hpp"

namespace piblocks::benchmark {

template <typename Scalar>
class LogWriter {
 public:
  LogWriter(std::span<const std::int64_t> wanted, const Deadline& deadline)
      : wanted_(wanted), deadline_(deadline) {
    log_.kept.reserve(wanted.size());
  }

  void push(const Scalar& time, const Scalar& blue, const Scalar& red) {
    Row& row = (*block_)[used_];
    row.time = time;
    row.blue = blue;
    row.red = red;
    if (++used_ == block_->size()) flush();
  }

  WholeLog finish() {
    flush();
    return std::move(log_);
  }

 private:
  struct Row {
    Scalar time;
    Scalar blue;
    Scalar red;
  };
  using Block = std::array<Row, 1024>;

  void flush() {
    asm volatile("" : : "r"(block_.get()) : "memory");  // the rows have a reader
    for (; !wanted_.empty() && wanted_.front() <= log_.count + std::ssize(used()); next_wanted()) {
      const Row& row = used()[static_cast<std::size_t>(wanted_.front() - log_.count - 1)];
      log_.kept.push_back(
          {wanted_.front(), Reference(row.time), Reference(row.blue), Reference(row.red)});
    }
    log_.count += std::ssize(used());
    used_ = 0;
    deadline_.check();
  }

  std::span<const Row> used() const { return {block_->data(), used_}; }
  void next_wanted() { wanted_ = wanted_.subspan(1); }

  std::unique_ptr<Block> block_ = std::make_unique<Block>();
  std::size_t used_ = 0;
  std::span<const std::int64_t> wanted_;
  const Deadline& deadline_;
  WholeLog log_;
};

}  // namespace piblocks::benchmark
