#include "scene/table.hpp"

#include <fmt/compile.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace piblocks {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(long) == 8,
              "rows of NumPy are written as they are in memory");

using Kind = TableLayout::Kind;

/// A whole number of any size that counts up, as text, without a division each time.
class DecimalCounter {
 public:
  explicit DecimalCounter(std::string digits) : digits_(std::move(digits)) {}

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

constexpr std::size_t kValue_bytes = 8;  // of an index or a number

/// Copies columns of values of 8 bytes into rows; each has its place there. Several at once take
/// half as long as one after the other.
template <std::size_t kColumns>
// NOLINTNEXTLINE(readability-non-const-parameter): `at` is written to
void write_columns(char* at, const void* const* columns, const std::size_t* places_bytes,
                   std::size_t rows, std::size_t row_bytes) {
  std::array<const char*, kColumns> from{};
  std::array<char*, kColumns> to{};
  for (std::size_t k = 0; k < kColumns; ++k) {
    from[k] = static_cast<const char*>(columns[k]);
    to[k] = at + places_bytes[k];
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < kColumns; ++k) {
      std::memcpy(to[k] + row * row_bytes, from[k] + row * kValue_bytes, kValue_bytes);
    }
  }
}

/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0
std::string npy_header(const std::string& row_type, const Integer& first, const Integer& count) {
  for (const Integer& index : {first, Integer(first + count - 1)}) {
    if (count == 0 || abs(index) <= to_integer(std::numeric_limits<std::int64_t>::max())) continue;
    throw UsageError(fmt::format("log: index {} does not fit in 64 bits of npy; use csv or jsonl",
                                 readable(index)));
  }
  constexpr std::size_t kAlignment_bytes = 64;  // of the first row
  std::string text = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({},), }}",
                                 row_type, count.get_str());
  std::string header("\x93NUMPY\x01\x00", 8);
  const std::size_t length = header.size() + 2 + text.size() + 1;  // with its own length, and '\n'
  text.append((kAlignment_bytes - length % kAlignment_bytes) % kAlignment_bytes, ' ');
  text += '\n';
  header += static_cast<char>(text.size() % 256);
  header += static_cast<char>(text.size() / 256);
  return header + text;
}

}  // namespace

Table::Table(TableLayout layout)
    : layout_(std::move(layout)),
      csv_(row_text(layout_.csv, &TableLayout::Word::csv)),
      json_(row_text(layout_.json, &TableLayout::Word::json)) {
  for (const auto& word : layout_.words) {
    assert(word.npy.size() <= kValue_bytes);
    std::memcpy(&words_.emplace_back(), word.npy.data(), word.npy.size());
  }
  for (const auto& column : layout_.columns) {
    places_bytes_.push_back(row_bytes_);
    if (column.kind != Kind::number) ++made_columns_;
    row_bytes_ += column.kind == Kind::word ? layout_.words.front().npy.size() : kValue_bytes;
  }
}

Table::Piece Table::piece_of(std::string_view text) {
  Piece piece{.size = text.size()};
  assert(piece.size <= piece.bytes.size());
  text.copy(piece.bytes.data(), piece.bytes.size());
  return piece;
}

Table::RowText Table::row_text(std::string_view row, std::string TableLayout::Word::*word) const {
  constexpr std::size_t kNumber_bytes = 24;  // "-1.7976931348623157e+308"
  std::unordered_map<std::string_view, std::size_t> places;
  for (const auto& column : layout_.columns) places.emplace(column.name, places.size());
  RowText text;
  std::size_t most_value_bytes = kNumber_bytes;
  for (const auto& one : layout_.words) {
    text.words.push_back(one.*word);
    most_value_bytes = std::max(most_value_bytes, text.words.back().size());
  }
  text.most_bytes = row.size() + 1;
  for (std::size_t open = 0; (open = row.find('<')) != std::string_view::npos;) {
    const std::size_t close = row.find('>');
    const std::size_t column = places.at(row.substr(open + 1, close - open - 1));
    text.cells.push_back({piece_of(row.substr(0, open)), column, layout_.columns[column].kind});
    text.most_bytes += most_value_bytes;
    row.remove_prefix(close + 1);
  }
  text.end = piece_of(std::string(row) + '\n');
  return text;
}

std::string Table::header(TableFormat format, const Integer& first, const Integer& count) const {
  if (format == TableFormat::npy) return npy_header(row_type(), first, count);
  if (format == TableFormat::jsonl) return {};
  std::string names = layout_.csv + '\n';
  std::erase_if(names, [](char c) { return c == '<' || c == '>'; });
  return names;
}

void Table::append(TableFormat format, const TableRows& rows, fmt::memory_buffer& out) const {
  if (format != TableFormat::npy) {
    return append_text(format == TableFormat::csv ? csv_ : json_, rows, out);
  }
  const std::size_t begin = out.size();
  out.resize(begin + rows.size * row_bytes_);
  write_npy(rows, out.data() + begin);
}

/// A number that is that of the row before is not formatted again: a block keeps its velocity until
/// it is hit.
void Table::append_text(const RowText& text, const TableRows& rows, fmt::memory_buffer& out) {
  DecimalCounter index(rows.is_infinite ? "infinite" : rows.first.get_str());
  const std::size_t begin = out.size();
  out.resize(begin + rows.size * (text.most_bytes + index.text().size() + 1) + sizeof(Piece));
  char* end = out.data() + begin;  // fmt writes to a plain pointer a fifth faster
  const auto add = [&](std::string_view piece) {
    std::memcpy(end, piece.data(), piece.size());
    end += piece.size();
  };
  const auto add_piece = [&](const char* bytes, std::size_t size) {
    std::memmove(end, bytes, sizeof Piece::bytes);
    end += size;
  };
  struct Value {
    Piece before;
    const double* number;       ///< the next one; nullptr of others
    const std::uint32_t* word;  ///< the same
    std::string_view text;      ///< of the number before
  };
  std::vector<Value> values;
  for (const auto& [before, column, kind] : text.cells) {
    const void* const at = rows.columns[column];
    values.push_back({before,
                      kind == Kind::number ? static_cast<const double*>(at) : nullptr,
                      kind == Kind::word ? static_cast<const std::uint32_t*>(at) : nullptr,
                      {}});
  }
  for (std::size_t row = 0; row < rows.size; ++row, index.increment()) {
    for (Value& value : values) {
      add_piece(value.before.bytes.data(), value.before.size);
      if (value.number != nullptr) {
        const double* const number = value.number++;
        char* const start = end;
        if (row > 0 && number[0] == number[-1]) {
          add_piece(value.text.data(), value.text.size());
        } else {
          end = fmt::format_to(end, FMT_COMPILE("{}"), shown(*number));
        }
        value.text = {start, std::size_t(end - start)};
      } else if (value.word != nullptr) {
        add(text.words[*value.word++]);
      } else {
        add(index.text());
      }
    }
    add_piece(text.end.bytes.data(), text.end.size);
  }
  out.resize(static_cast<std::size_t>(end - out.data()));
}

/// Of a word that is shorter than 8 bytes, the next column, which is written later, covers the
/// rest.
void Table::write_npy(const TableRows& rows, char* at) const {
  constexpr std::size_t kAtOnce = 4;
  std::vector<const void*> columns = rows.columns;
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): not filled twice
  const auto made = std::make_unique_for_overwrite<std::uint64_t[]>(made_columns_ * rows.size);
  std::uint64_t* next = made.get();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Kind kind = layout_.columns[i].kind;
    if (kind == Kind::number) continue;
    const auto* const words = static_cast<const std::uint32_t*>(std::exchange(columns[i], next));
    if (kind == Kind::index) {
      std::iota(next, next + rows.size, static_cast<std::uint64_t>(rows.first.get_si()));
    } else {
      std::transform(words, words + rows.size, next,
                     [words = words_.data()](std::uint32_t place) { return words[place]; });
    }
    next += rows.size;
  }
  for (std::size_t i = 0; i < columns.size();) {
    const bool are_many = columns.size() - i >= kAtOnce;
    (are_many ? write_columns<kAtOnce> : write_columns<1>)(at, &columns[i], &places_bytes_[i],
                                                           rows.size, row_bytes_);
    i += are_many ? kAtOnce : 1;
  }
}

}  // namespace piblocks
