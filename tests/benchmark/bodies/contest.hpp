// Several methods that answer one question: how long each takes, and how wrong it is.
// In: functions that answer it in numbers of any type, and the right answers. Out: times and
// errors.
#pragma once

#include <boost/multiprecision/mpfr.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/log.hpp>

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/real.hpp"

namespace piblocks::benchmark {

namespace mp = boost::multiprecision;

using Decimal50 = mp::number<mp::mpfr_float_backend<50>, mp::et_off>;  ///< MPFR, 50 digits
/// MPFR, 120 digits, which are 400 bits: right answers, and what errors are measured in.
using Wide = mp::number<mp::mpfr_float_backend<120>, mp::et_off>;

inline Wide to_wide(const Rational& value) {
  Wide result;
  mpfr_set_q(result.backend().data(), value.get_mpq_t(), MPFR_RNDN);
  return result;
}
inline Wide to_wide(double value) { return {value}; }
inline Wide to_wide(long double value) { return {value}; }
inline Wide to_wide(const Decimal50& value) { return Wide(value); }
inline Wide to_wide(const Wide& value) { return value; }
inline Wide to_wide(const Time& value) { return Wide(value.hi) + value.lo; }
inline Wide to_wide(const Real& value) { return to_wide(value.to_rational()); }

/// The nearest number of the type.
template <typename Number>
Number to_number(const Rational& value) {
  if constexpr (std::is_same_v<Number, Rational>) {
    return value;
  } else if constexpr (std::is_same_v<Number, double>) {
    return to_double(value);
  } else {
    return static_cast<Number>(to_wide(value));
  }
}

template <typename Number>
inline const std::string kNumberName = "";
template <>
inline const std::string kNumberName<double> = "double";
template <>
inline const std::string kNumberName<long double> = "long double";
template <>
inline const std::string kNumberName<Decimal50> = "MPFR 50 digits";

using Answers = std::vector<Wide>;

struct Contestant {
  std::string method;
  std::string number;              ///< type
  std::function<void()> run;       ///< answers, and throws the answers away
  std::function<Answers()> reply;  ///< answers, without rounding
  std::vector<double> seconds = {};
};

/// Converting the answers is no part of the method's work.
/// @param ask  returns a vector of numbers of some type
template <typename Ask>
Contestant contestant(std::string method, std::string number, Ask ask) {
  const auto run = [ask] {
    const volatile auto size = ask().size();  // so that the compiler does not drop the call
    static_cast<void>(size);
  };
  const auto reply = [ask] {
    Answers answers;
    for (const auto& value : ask()) answers.push_back(to_wide(value));
    return answers;
  };
  return {std::move(method), std::move(number), run, reply};
}

/// Runs all of them in three rounds, each at least three times and for 0.2 s altogether: what else
/// the machine does in one round slows no method alone.
void time_all(std::vector<Contestant>& contestants);

/// Processor time of one run, as "12.3 ms".
std::string time_text(const Contestant& contestant);
/// One digit, as "3e-16"; "0"; a dash if there is none.
std::string error_text(const std::optional<double>& error);

/// How many states each method is asked for.
inline constexpr int kInstants = 200;

/// Times from 0 to `end`, ascending, `end` the last. The same in each run.
std::vector<double> random_instants(double end, int number);

}  // namespace piblocks::benchmark
