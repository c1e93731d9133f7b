// log --format npy: the bytes of the file, and what NumPy makes of them.
#include <cstdint>
#include <cstring>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

class NpyTest : public CliFixture {
 protected:
  /// What `python3 -c PROGRAM` does in the test's folder.
  bool python(const std::string& interpreter, const std::string& program) const {
    write("program.py", program);
    return shell(interpreter + " program.py >python.txt 2>&1 && echo done || true") == "done\n";
  }
  /// A Python that has NumPy; empty if there is none. Debian's own may hide behind another one.
  std::string python_with_numpy() const {
    for (const char* interpreter : {"python3", "/usr/bin/python3"}) {
      if (python(interpreter, "import numpy")) return interpreter;
    }
    return {};
  }
};

constexpr std::size_t kRow_bytes = 8 + 8 + 8 + 6 + 4 * 8;

template <typename Value>
Value value_at(const std::string& bytes, std::size_t at) {
  Value value;
  std::memcpy(&value, bytes.substr(at, sizeof value).data(), sizeof value);
  return value;
}

/// Length of everything before the rows.
std::size_t header_bytes(const std::string& npy) { return 10U + value_at<std::uint16_t>(npy, 8); }

/// Times that one double cannot tell apart differ in their low parts.
TEST_F(NpyTest, TellsCollisionsNearTheTurnApart) {
  const std::string npy = output_of(
      {"log", "--digits", "12", "--first", "157079632600", "--limit", "100", "--format", "npy"});
  const auto time = [&](std::size_t row, std::size_t part) {
    return value_at<double>(npy, header_bytes(npy) + row * kRow_bytes + 8 + 8 * part);
  };
  EXPECT_EQ(time(0, 0), time(99, 0));
  for (std::size_t row = 1; row < 100; ++row) EXPECT_GT(time(row, 1), time(row - 1, 1)) << row;
}

TEST_F(NpyTest, NumpyLoadsWhatCsvSays) {
  const std::string interpreter = python_with_numpy();
  if (interpreter.empty()) GTEST_SKIP() << "no python3 with numpy here";
  output_of({"log", "--digits", "5", "--format", "npy", "-o", "log.npy"});
  output_of({"log", "--digits", "5", "-o", "log.csv"});
  EXPECT_TRUE(python(interpreter, R"(
import numpy
log = numpy.load('log.npy')
csv = numpy.genfromtxt('log.csv', delimiter=',', names=True, dtype=None, encoding='ascii')
assert log.shape == csv.shape == (31415,), log.shape
for name in csv.dtype.names:
    column = log[name].astype(str) if name == 'kind' else log[name]
    assert (column == csv[name]).all(), name
assert (numpy.diff(log['time']) >= 0).all()
)")) << contents("python.txt");
}

}  // namespace
}  // namespace piblocks
