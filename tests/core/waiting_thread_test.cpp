// Calls that wait, broken off by a signal.
#include "core/waiting_thread.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <thread>

#include "core/descriptor.hpp"

namespace piblocks {
namespace {

class WaitingThreadTest : public testing::Test {
 protected:
  void SetUp() override {
    struct sigaction action {};
    action.sa_handler = [](int) {};  // without SA_RESTART
    ASSERT_EQ(::sigaction(SIGURG, &action, &before_), 0);
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    reader_ = Descriptor(ends[0]);
    writer_ = Descriptor(ends[1]);
  }
  void TearDown() override { ::sigaction(SIGURG, &before_, nullptr); }

  /// @return the errno of a read from a pipe that nobody writes to.
  int error_of_read() const {
    char byte = 0;
    return ::read(reader_.get(), &byte, 1) < 0 ? errno : 0;
  }
  template <typename Condition>
  static void break_off_until(const Condition& is_over) {
    while (!is_over()) {
      break_off_calls(SIGURG);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  Descriptor reader_;
  Descriptor writer_;

 private:
  struct sigaction before_ {};
};

TEST_F(WaitingThreadTest, IsBrokenOffInEveryMarkedThread) {
  std::array<std::atomic<int>, 3> errors{};
  std::array<std::thread, 3> threads;
  for (std::size_t i = 0; i < threads.size(); ++i) {
    threads[i] = std::thread([this, &error = errors[i]] {
      const WaitingThread this_thread;
      error = error_of_read();
    });
  }
  break_off_until(
      [&] { return std::ranges::all_of(errors, [](const auto& error) { return error != 0; }); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& error : errors) EXPECT_EQ(error, EINTR);
}

TEST_F(WaitingThreadTest, IsLeftAloneWithoutAMark) {
  std::atomic<int> error = -1;
  std::thread thread([&] {
    { const WaitingThread no_longer; }
    error = error_of_read();
  });
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
  break_off_until([&] { return std::chrono::steady_clock::now() > end; });
  EXPECT_EQ(error, -1);
  writer_ = Descriptor();  // the end of the pipe: the read returns 0
  thread.join();
  EXPECT_EQ(error, 0);
}

}  // namespace
}  // namespace piblocks
