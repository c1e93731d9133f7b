// Text that looks like what is on screens, the same on every machine.
// In: a seed. Out: lines of a log or of a program.
#pragma once

#include <random>
#include <string>

namespace piblocks::benchmark {

class SampleText {
 public:
  explicit SampleText(unsigned seed) : random_(seed) {}

  /// 0 to count - 1
  int pick(int count) { return int(random_() % unsigned(count)); }
  std::string word();
  /// As a compiler or a test prints it.
  std::string log_line();
  /// A statement, a comment or nothing, indented.
  std::string code_line();
  std::string sentence(int words);

 private:
  std::mt19937 random_;
};

}  // namespace piblocks::benchmark
