#include "cli/log_format.hpp"

#include <fmt/compile.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string_view>

#include "cli/options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {
namespace {

/// A whole number of any size that counts up, as text, without a division each time.
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

static_assert(std::endian::native == std::endian::little && sizeof(long) == 8,
              "rows are written as they are in memory");

constexpr std::string_view kRowType =
    "[('index', '<i8'), ('time', '<f8'), ('time_low', '<f8'), ('kind', '|S6'), "
    "('x_blue', '<f8'), ('x_red', '<f8'), ('v_blue', '<f8'), ('v_red', '<f8')]";
using Kind = std::array<char, 6>;
constexpr std::size_t kRow_bytes = 7 * 8 + sizeof(Kind);  // without gaps

constexpr Kind kWall{'w', 'a', 'l', 'l'};
constexpr Kind kBlocks{'b', 'l', 'o', 'c', 'k', 's'};

template <typename Value>
char* put(char* at, const Value& value) {
  std::memcpy(at, &value, sizeof value);
  return at + sizeof value;
}

std::string npy_header(const Integer& rows) {
  constexpr std::size_t kAlignment_bytes = 64;  // of the first row
  std::string text = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({},), }}",
                                 kRowType, rows.get_str());
  std::string header("\x93NUMPY\x01\x00", 8);
  const std::size_t length = header.size() + 2 + text.size() + 1;  // with its own length, and '\n'
  text.append((kAlignment_bytes - length % kAlignment_bytes) % kAlignment_bytes, ' ');
  text += '\n';
  header += static_cast<char>(text.size() % 256);
  header += static_cast<char>(text.size() / 256);
  return header + text;
}

void append_npy(const CollisionBatch& batch, fmt::memory_buffer& out) {
  const std::size_t begin = out.size();
  out.resize(begin + batch.size * kRow_bytes);
  char* at = out.data() + begin;
  const std::int64_t first = batch.first.get_si();
  for (std::size_t i = 0; i < batch.size; ++i) {
    at = put(at, first + static_cast<std::int64_t>(i));
    at = put(at, batch.time_hi[i]);
    at = put(at, batch.time_lo[i]);
    at = put(at, batch.kind[i] == CollisionKind::wall ? kWall : kBlocks);
    at = put(at, batch.blue_position[i]);
    at = put(at, batch.red_position[i]);
    at = put(at, batch.blue_velocity[i]);
    at = put(at, batch.red_velocity[i]);
  }
}

const char* name_of(CollisionKind kind) { return kind == CollisionKind::wall ? "wall" : "blocks"; }

/// Appends a row each, its text as `format` says: index, time, kind, positions, velocities.
template <typename CompiledFormat>
void append_rows(const CollisionBatch& batch, const CompiledFormat& format,
                 fmt::memory_buffer& out) {
  DecimalCounter index(batch.first);
  constexpr std::size_t kMaxRest_bytes = 256;  // five numbers of at most 24 bytes, and names
  const std::size_t begin = out.size();
  out.resize(begin + batch.size * (index.text().size() + 1 + kMaxRest_bytes));
  char* end = out.data() + begin;  // fmt writes to a plain pointer a fifth faster
  for (std::size_t i = 0; i < batch.size; ++i, index.increment()) {
    end = fmt::format_to(end, format, index.text(), shown(batch.time_hi[i]), name_of(batch.kind[i]),
                         shown(batch.blue_position[i]), shown(batch.red_position[i]),
                         shown(batch.blue_velocity[i]), shown(batch.red_velocity[i]));
  }
  out.resize(static_cast<std::size_t>(end - out.data()));
}

std::string csv_header(const Rows& /*rows*/) {
  return "index,time,kind,x_blue,x_red,v_blue,v_red\n";
}

void append_csv(const CollisionBatch& batch, fmt::memory_buffer& out) {
  append_rows(batch, FMT_COMPILE("{},{},{},{},{},{},{}\n"), out);
}

void append_jsonl(const CollisionBatch& batch, fmt::memory_buffer& out) {
  append_rows(batch,
              FMT_COMPILE("{{\"index\":\"{}\",\"time\":{},\"kind\":\"{}\",\"x_blue\":{},"
                          "\"x_red\":{},\"v_blue\":{},\"v_red\":{}}}\n"),
              out);
}

std::string no_header(const Rows& /*rows*/) { return {}; }

std::string checked_npy_header(const Rows& rows) {
  for (const Integer& index : {rows.first, rows.last}) {
    if (rows.count() == 0 || abs(index) <= std::numeric_limits<std::int64_t>::max()) continue;
    throw UsageError(fmt::format("--format npy: index {} does not fit in 64 bits; use csv or jsonl",
                                 readable(index)));
  }
  return npy_header(rows.count());
}

}  // namespace

LogFormat parse_log_format(const std::string& text) {
  return parse_choice<LogFormat>(text, {{"csv", {true, csv_header, append_csv}},
                                        {"jsonl", {true, no_header, append_jsonl}},
                                        {"npy", {false, checked_npy_header, append_npy}}});
}

}  // namespace piblocks::cli
