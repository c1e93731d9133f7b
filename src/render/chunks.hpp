// How the frames of a rendering are cut into chunks, and how threads work on them.
// In: the number of frames; tasks numbered from 0. Out: where each chunk begins and ends; each
// task's result in order, though tasks run in any, with only a few results waiting at any time.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "core/threads.hpp"

namespace piblocks {

/// Consecutive frames that are encoded together. Chunk k begins at frame k * frames_per_chunk; the
/// last has from half of that length to one and a half, so that no worker is left with a mere few
/// frames.
struct Chunks {
  std::int64_t frame_count;
  std::int64_t frames_per_chunk;

  std::int64_t count() const {
    if (frame_count == 0) return 0;
    return std::max<std::int64_t>(1, (frame_count + frames_per_chunk / 2) / frames_per_chunk);
  }
  /// The first frame of a chunk; of the one after the last, the number of frames.
  std::int64_t begin(std::int64_t chunk) const {
    return chunk == count() ? frame_count : chunk * frames_per_chunk;
  }
  std::int64_t end(std::int64_t chunk) const { return begin(chunk + 1); }
};

/// Runs `count` tasks on `workers` threads; one by one, when their results are taken, where there
/// are no threads. At most 2 * workers tasks are begun beyond the last
/// one whose result was taken, which bounds the memory that results hold.
template <typename Result>
class OrderedPool {
 public:
  /// Makes one worker's function: task number and stop signal -> result. Called on its thread,
  /// so that a worker can own what it works with.
  using Task = std::function<Result(std::int64_t, const std::stop_token&)>;
  using MakeTask = std::function<Task()>;

  OrderedPool(std::int64_t count, int workers, const MakeTask& make_task)
      : count_(count), window_(2 * std::int64_t{workers}) {
    if constexpr (!kHasThreads) {
      if (count > 0) task_ = make_task();
      return;
    }
    for (std::int64_t i = 0; i < std::min<std::int64_t>(workers, count); ++i) {
      try {
        threads_.push_back(start_thread([&] {
          return std::jthread(
              [this, make_task](const std::stop_token& halt) { work(make_task, halt); });
        }));
      } catch (const IoError&) {
        if (threads_.empty()) throw;
        break;  // fewer threads do the same work
      }
    }
  }

  /// The result of the next task in order; nothing after the last or when told to stop.
  /// Rethrows the first exception of any task.
  /// @param while_waiting  called ten times a second.
  std::optional<Result> take(
      const std::stop_token& stop, const std::function<void()>& while_waiting = [] {}) {
    if constexpr (!kHasThreads) return take_here(stop);
    std::unique_lock lock(mutex_);
    if (next_to_take_ == count_) return std::nullopt;
    const auto is_ready = [this] {
      return failure_ != nullptr || results_.contains(next_to_take_);
    };
    while (!changed_.wait_for(lock, stop, kCallInterval, is_ready)) {
      if (stop.stop_requested()) return std::nullopt;
      lock.unlock();
      while_waiting();
      lock.lock();
    }
    if (failure_ != nullptr) std::rethrow_exception(failure_);
    auto node = results_.extract(next_to_take_);
    ++next_to_take_;
    lock.unlock();
    changed_.notify_all();
    // cppcheck-suppress returnStdMoveLocal ; a reference into the node, not a local object
    return std::move(node.mapped());
  }

 private:
  static constexpr std::chrono::milliseconds kCallInterval{100};

  std::optional<Result> take_here(const std::stop_token& stop) {
    if (next_to_take_ == count_ || stop.stop_requested()) return std::nullopt;
    return task_(next_to_take_++, stop);
  }

  void work(const MakeTask& make_task, const std::stop_token& stop) {
    try {
      const Task task = make_task();
      while (const auto index = begin_task(stop)) {
        Result result = task(*index, stop);
        const std::lock_guard lock(mutex_);
        results_.emplace(*index, std::move(result));
        changed_.notify_all();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (failure_ == nullptr) failure_ = std::current_exception();
      changed_.notify_all();
    }
  }

  std::optional<std::int64_t> begin_task(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    const bool room = changed_.wait(lock, stop, [this] {
      return failure_ != nullptr || next_to_begin_ == count_ ||
             next_to_begin_ < next_to_take_ + window_;
    });
    if (!room || failure_ != nullptr || next_to_begin_ == count_) return std::nullopt;
    return next_to_begin_++;
  }

  const std::int64_t count_;
  const std::int64_t window_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::map<std::int64_t, Result> results_;
  std::int64_t next_to_begin_ = 0;
  std::int64_t next_to_take_ = 0;
  std::exception_ptr failure_;
  Task task_;                          // without threads
  std::vector<std::jthread> threads_;  // last: joined before the rest is gone
};

}  // namespace piblocks
