// A whole number that counts up, as text.
// In: where to start, of any size. Out: its digits, without a division or a big number each time.
#pragma once

#include <piblocks/exact.hpp>

#include <string>
#include <string_view>

namespace piblocks::cli {

class DecimalCounter {
 public:
  explicit DecimalCounter(const Integer& first) : digits_(first.get_str()) {}

  std::string_view text() const { return digits_; }
  void increment() {
    if (digits_.front() == '-') {  // only the rows before time 0
      digits_ = Integer(Integer(digits_, 10) + 1).get_str();
      return;
    }
    for (auto digit = digits_.rbegin(); digit != digits_.rend(); ++digit) {
      if (*digit != '9') {
        ++*digit;
        return;
      }
      *digit = '0';
    }
    digits_.insert(0, 1, '1');
  }

 private:
  std::string digits_;
};

}  // namespace piblocks::cli
