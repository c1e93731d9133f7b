// Threads that work on numbered tasks, and hand on the results in order.
// In: tasks numbered from 0. Out: each task's result in order, though tasks run in any, with only a
// few results waiting at any time.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "core/threads.hpp"

namespace piblocks {

/// Runs `count` tasks on `workers` threads; one by one, when their results are taken, where there
/// are no threads. At most 2 * workers tasks are begun beyond the last one whose result was taken,
/// which bounds the memory that results hold; 16 * workers while those that wait hold little, so
/// that a task that takes long keeps no thread waiting.
template <typename Result>
class OrderedPool {
 public:
  /// Makes one worker's function: task number and stop signal -> result. Called on its thread,
  /// so that a worker can own what it works with.
  using Task = std::function<Result(std::int64_t, const std::stop_token&)>;
  using MakeTask = std::function<Task()>;
  /// The memory that a result holds, in bytes.
  using Weigh = std::function<std::size_t(const Result&)>;
  static constexpr std::size_t kLittle = std::size_t{32} << 20;

  OrderedPool(std::int64_t count, int workers, const MakeTask& make_task, Weigh weigh)
      : count_(count), workers_(workers), weigh_(std::move(weigh)) {
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
  /// @throws what that task has thrown, also if a later task has thrown before it; what making a
  ///         task has thrown
  /// @param while_waiting  called ten times a second.
  std::optional<Result> take(
      const std::stop_token& stop, const std::function<void()>& while_waiting = [] {}) {
    if (next_to_take_ == count_ || stop.stop_requested()) return std::nullopt;
    if constexpr (!kHasThreads) return task_(next_to_take_++, stop);
    std::unique_lock lock(mutex_);
    const auto is_ready = [this] {
      return failed_ <= next_to_take_ || results_.contains(next_to_take_);
    };
    while (!changed_.wait_for(lock, stop, kCallInterval, is_ready)) {
      if (stop.stop_requested()) return std::nullopt;
      lock.unlock();
      while_waiting();
      lock.lock();
    }
    if (failed_ <= next_to_take_) std::rethrow_exception(failure_);
    auto node = results_.extract(next_to_take_);
    ++next_to_take_;
    held_ -= weigh_(node.mapped());
    lock.unlock();
    changed_.notify_all();
    // cppcheck-suppress returnStdMoveLocal ; a reference into the node, not a local object
    return std::move(node.mapped());
  }

 private:
  static constexpr std::chrono::milliseconds kCallInterval{100};

  void work(const MakeTask& make_task, const std::stop_token& stop) {
    std::optional<std::int64_t> index;
    try {
      const Task task = make_task();
      while ((index = begin_task(stop))) {
        Result result = task(*index, stop);
        const std::lock_guard lock(mutex_);
        held_ += weigh_(result);
        results_.emplace(*index, std::move(result));
        changed_.notify_all();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (const std::int64_t failed = index.value_or(-1); failed < failed_) {
        failed_ = failed;
        failure_ = std::current_exception();
      }
      changed_.notify_all();
    }
  }

  std::optional<std::int64_t> begin_task(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    const bool room = changed_.wait(lock, stop, [this] {
      return has_failed() || next_to_begin_ == count_ ||
             next_to_begin_ < next_to_take_ + (held_ <= kLittle ? 16 : 2) * workers_;
    });
    if (!room || has_failed() || next_to_begin_ == count_) return std::nullopt;
    return next_to_begin_++;
  }
  bool has_failed() const { return failure_ != nullptr; }

  const std::int64_t count_;
  const std::int64_t workers_;
  const Weigh weigh_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::map<std::int64_t, Result> results_;
  std::size_t held_ = 0;  ///< bytes of results_
  std::int64_t next_to_begin_ = 0;
  std::int64_t next_to_take_ = 0;
  std::exception_ptr failure_;  // of the first task in order that has failed
  std::int64_t failed_ = std::numeric_limits<std::int64_t>::max();  // its number
  Task task_;                                                       // without threads
  std::vector<std::jthread> threads_;  // last: joined before the rest is gone
};

}  // namespace piblocks
