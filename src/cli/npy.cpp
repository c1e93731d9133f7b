#include "cli/npy.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <string_view>

namespace piblocks::cli {
namespace {

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

}  // namespace

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

}  // namespace piblocks::cli
