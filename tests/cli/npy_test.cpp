// log --format npy: the bytes of the file, and what NumPy makes of them.
#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

class NpyTest : public CliFixture {
 protected:
  /// What `python3 -c PROGRAM` does in the test's folder.
  bool python(const std::string& interpreter, const std::string& program) const {
    write("program.py", program);
    const std::string command = fmt::format("cd '{}' && {} program.py >python.txt 2>&1",
                                            folder_.path().string(), interpreter);
    return std::system(command.c_str()) == 0;
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

TEST_F(NpyTest, HasTheHeaderOfVersionOne) {
  for (const char* digits : {"1", "2", "3", "4", "5"}) {
    const std::string npy = output_of({"log", "--digits", digits, "--format", "npy"});
    const std::string count = lines(output_of({"count", "--digits", digits})).front();
    ASSERT_TRUE(npy.starts_with(std::string("\x93NUMPY\x01\x00", 8)));
    EXPECT_EQ(header_bytes(npy) % 64, 0u);
    ASSERT_EQ(npy.size(), header_bytes(npy) + std::stoul(count) * kRow_bytes);
    const std::string text = npy.substr(10, header_bytes(npy) - 10);
    const std::string dictionary = fmt::format(
        "{{'descr': [('index', '<i8'), ('time', '<f8'), ('time_low', '<f8'), ('kind', '|S6'), "
        "('x_blue', '<f8'), ('x_red', '<f8'), ('v_blue', '<f8'), ('v_red', '<f8')], "
        "'fortran_order': False, 'shape': ({},), }}",
        count);
    ASSERT_TRUE(text.starts_with(dictionary)) << text;
    EXPECT_EQ(text.substr(dictionary.size()).find_first_not_of(' '),
              text.size() - dictionary.size() - 1);
    EXPECT_EQ(text.back(), '\n');
  }
}

TEST_F(NpyTest, RowsSayWhatCsvSays) {
  output_of({"log", "--digits", "4", "--format", "npy", "-o", "log.npy"});
  const std::string npy = contents("log.npy");
  const auto csv = lines(output_of({"log", "--digits", "4"}));
  ASSERT_EQ(npy.size(), header_bytes(npy) + (csv.size() - 1) * kRow_bytes);
  for (std::size_t row = 1; row < csv.size(); ++row) {
    const auto fields = split(csv[row], ',');
    const std::size_t at = header_bytes(npy) + (row - 1) * kRow_bytes;
    ASSERT_EQ(std::to_string(value_at<std::int64_t>(npy, at)), fields[0]);
    ASSERT_EQ(value_at<double>(npy, at + 8), std::stod(fields[1]));
    ASSERT_LE(std::abs(value_at<double>(npy, at + 16)), 0x1p-51);
    ASSERT_EQ(std::string(npy.substr(at + 24, 6).c_str()), fields[2]);
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_EQ(value_at<double>(npy, at + 30 + 8 * i), std::stod(fields[3 + i])) << csv[row];
    }
  }
}

TEST_F(NpyTest, NoRowsAreAnEmptyArray) {
  const std::string npy = output_of({"log", "--digits", "20", "--to", "-1", "--format", "npy"});
  EXPECT_EQ(npy.size(), header_bytes(npy));
  EXPECT_NE(npy.find("'shape': (0,)"), std::string::npos);
}

TEST_F(NpyTest, HoldsTheLargestIndexOf64Bits) {
  const std::string npy = output_of({"log", "--digits", "20", "--first", "9223372036854775806",
                                     "--limit", "2", "--format", "npy"});
  const std::size_t last = header_bytes(npy) + kRow_bytes;
  EXPECT_EQ(value_at<std::int64_t>(npy, last), INT64_MAX);
}

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
