#include "screen/sample_text.hpp"

#include <fmt/format.h>

#include <array>

namespace piblocks::benchmark {

std::string SampleText::word() {
  constexpr std::array kWords = {"buffer",  "index",  "total",  "read",    "update", "stream",
                                 "parse",   "socket", "window", "counter", "merge",  "table",
                                 "encode",  "matrix", "offset", "first",   "limit",  "render",
                                 "version", "column", "store",  "message", "length", "queue",
                                 "signal",  "layer",  "key",    "value",   "source", "target"};
  return kWords.at(std::size_t(pick(kWords.size())));
}

std::string SampleText::sentence(int words) {
  std::string text = word();
  for (int i = 1; i < words; ++i) text += ' ' + word();
  return text;
}

std::string SampleText::log_line() {
  const int kind = pick(4);
  if (kind == 0) {
    return fmt::format("[{:3}/412] Building CXX object src/{}/{}_{}.cpp.o", 1 + pick(412), word(),
                       word(), word());
  }
  if (kind == 1) {
    return fmt::format("src/{}.cpp:{}:{}: warning: '{}' {}", word(), 1 + pick(900), 1 + pick(80),
                       word(), sentence(4 + pick(6)));
  }
  if (kind == 2) {
    return fmt::format("drwxr-xr-x 2 anna users {:8} Mar {:2} {:02}:{:02} {}_{}", pick(9'000'000),
                       1 + pick(31), pick(24), pick(60), word(), word());
  }
  return fmt::format("  {} ... ok ({} ms)", sentence(3 + pick(7)), pick(2000));
}

std::string SampleText::code_line() {
  const std::string indent(std::size_t(2 + 2 * pick(4)), ' ');
  const int kind = pick(6);
  if (kind == 0) return {};
  if (kind == 1) return indent + "// " + sentence(3 + pick(8));
  if (kind == 2)
    return fmt::format("{}if ({} < {}_{}) return {};", indent, word(), word(), word(), word());
  if (kind == 3) return fmt::format("{}for (int {} : {}.{}()) {{", indent, word(), word(), word());
  if (kind == 4)
    return fmt::format("{}const auto {} = {}_{}({}, {});", indent, word(), word(), word(), word(),
                       pick(1000));
  return fmt::format("{}{}.{}({} + {});", indent, word(), word(), word(), pick(100));
}

}  // namespace piblocks::benchmark
