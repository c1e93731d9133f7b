#include "core/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace piblocks {
namespace {

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

/// Letters to insert, remove, replace or swap with their neighbour until one word is the other
/// (optimal string alignment: Damerau and Levenshtein's distance without a second change of the
/// swapped letters).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;  // the last row but one
  std::vector<std::size_t> last;
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::move(last);
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t kMaxWord = 40;  // nothing longer is a misspelt name
  if (names.empty() || word.empty() || word.size() > kMaxWord) return {};
  const std::string wanted = in_small_letters(word);
  const auto begins_so = [&](const std::string& name) { return name.starts_with(wanted); };
  if (std::ranges::count_if(names, begins_so) == 1) {
    return *std::ranges::find_if(names, begins_so);
  }
  const auto distance = [&](const std::string& name) {
    return edit_distance(wanted, in_small_letters(name));
  };
  const auto nearest = std::ranges::min_element(names, {}, distance);
  return distance(*nearest) <= std::max<std::size_t>(1, (word.size() + 1) / 3) ? *nearest : "";
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::string near = nearest_name(word, names);
  return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

std::string must_be_one_of(std::string_view word, const std::vector<std::string>& names) {
  const bool is_pair = names.size() == 2;
  return fmt::format("must be {}{}{}",
                     is_pair ? "" : "one of: ", fmt::join(names, is_pair ? " or " : ", "),
                     did_you_mean(word, names));
}

}  // namespace piblocks
