#include "scene/table.hpp"

#include <fmt/compile.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace piblocks {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(long) == 8,
              "rows of NumPy are written as they are in memory");

constexpr std::size_t kNumber_bytes = 8;

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

std::size_t vectors_of(const Column& column) { return std::max<std::size_t>(column.vectors, 1); }
std::size_t axes_of(const Column& column) { return std::max<std::size_t>(column.axes.size(), 1); }

std::string type_of(const Column& column, const Words& words) {
  std::string shape = column.vectors > 0 ? fmt::format("{},", column.vectors) : "";
  if (!column.axes.empty()) shape += fmt::format("{},", column.axes.size());
  const std::string type = column.kind == Column::Kind::index    ? "<i8"
                           : column.kind == Column::Kind::number ? "<f8"
                                                                 : words.type;
  return fmt::format("('{}', '{}'{})", column.name, type,
                     shape.empty() ? "" : fmt::format(", ({})", shape));
}

}  // namespace

/// Lays out rows of text: pieces of text in turn with cells.
class TextLayout {
 public:
  using Kind = Column::Kind;

  explicit TextLayout(const std::vector<Column>& columns) : columns_(columns) {
    std::array<std::size_t, 3> next = {};
    for (const Column& column : columns) {
      std::size_t& place = next.at(std::size_t(column.kind));
      places_.push_back(place);
      place += vectors_of(column) * axes_of(column);
    }
  }

  Table::Text csv() {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& column = columns_[i];
      if (column.key.empty() || column.vectors > 0) continue;
      for (std::size_t axis = 0; axis < axes_of(column); ++axis) {
        if (!text_.cells.empty()) add(",");
        text_.begin += text_.cells.empty() ? "" : ",";
        text_.begin += column.axes.empty() ? column.name : column.axes[axis];
        add_cell(i, axis);
      }
    }
    text_.begin += "\n";
    add("\n");
    text_.end = piece();
    return std::move(text_);
  }

  Table::Text json() {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::string& key = columns_[i].key;
      const auto is_same = [&](const Column& column) { return column.key == key; };
      const auto before = columns_.begin() + std::ptrdiff_t(i);
      if (key.empty() || std::any_of(columns_.begin(), before, is_same)) continue;
      add(text_.cells.empty() ? "{\"" : ",\"", key, "\":");
      add_value_of_key(i);
    }
    add("}\n");
    text_.end = piece();
    return std::move(text_);
  }

 private:
  template <typename... Texts>
  void add(const Texts&... texts) {
    ((pending_ += texts), ...);
  }

  /// What has been added since the last piece.
  Table::Piece piece() {
    Table::Piece piece{.size = pending_.size()};
    assert(piece.size <= piece.bytes.size());
    std::ranges::copy(std::exchange(pending_, {}), piece.bytes.begin());
    return piece;
  }

  void add_cell(std::size_t column, std::size_t coordinate) {
    text_.cells.push_back({piece(), columns_[column].kind, places_[column] + coordinate});
  }

  /// The value, or the object or list of objects, of a key. @param first  column of the key
  void add_value_of_key(std::size_t first) {
    std::vector<std::size_t> columns;
    for (std::size_t i = first; i < columns_.size(); ++i) {
      if (columns_[i].key == columns_[first].key) columns.push_back(i);
    }
    std::ranges::sort(columns, {}, [&](std::size_t i) { return columns_[i].inner_key; });
    const std::size_t vectors = columns_[first].vectors;
    if (vectors > 0) add("[");
    for (std::size_t vector = 0; vector < vectors_of(columns_[first]); ++vector) {
      if (vector > 0) add(",");
      add_object(columns, vector);
    }
    if (vectors > 0) add("]");
  }

  void add_object(const std::vector<std::size_t>& columns, std::size_t vector) {
    if (columns_[columns.front()].inner_key.empty()) return add_vector(columns.front(), vector);
    const char* separator = "{\"";
    for (const std::size_t i : columns) {
      add(std::exchange(separator, ",\""), columns_[i].inner_key, "\":");
      add_vector(i, vector);
    }
    add("}");
  }

  void add_vector(std::size_t i, std::size_t vector) {
    const Column& column = columns_[i];
    const bool is_index = column.kind == Kind::index;  // a string, because it may be of any size
    add(is_index ? "\"" : column.axes.empty() ? "" : "[");
    for (std::size_t axis = 0; axis < axes_of(column); ++axis) {
      if (axis > 0) add(",");
      add_cell(i, vector * axes_of(column) + axis);
    }
    add(is_index ? "\"" : column.axes.empty() ? "" : "]");
  }

  const std::vector<Column>& columns_;
  std::vector<std::size_t> places_;  ///< of the first cell of each column
  Table::Text text_;
  std::string pending_;  ///< before the next cell
};

/// Writes values of eight bytes to their places in each row.
template <std::size_t kColumns>
void Table::write_columns(const void* const* columns, const Field* fields, std::size_t rows,
                          std::size_t row_bytes, char* at) {
  std::array<const char*, kColumns> from{};
  std::array<char*, kColumns> to{};
  for (std::size_t k = 0; k < kColumns; ++k) {
    from[k] = static_cast<const char*>(columns[k]);
    to[k] = at + fields[k].place_bytes;
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < kColumns; ++k) {
      std::memcpy(to[k] + row * row_bytes, from[k] + row * kNumber_bytes, kNumber_bytes);
    }
  }
}

Table::Table(const std::vector<Column>& columns, const Words& words)
    : csv_(TextLayout(columns).csv()), json_(TextLayout(columns).json()) {
  for (const Word& word : words.list) {
    csv_.add_word(word.csv);
    json_.add_word(word.json);
    word_bytes_ = word.numpy.size();
    assert(word_bytes_ <= sizeof(std::uint64_t));
    std::memcpy(&words_.emplace_back(), word.numpy.data(), word_bytes_);
  }
  for (const Column& column : columns) {
    row_type_ += (row_type_.empty() ? "[" : ", ") + type_of(column, words);
    for (std::size_t i = 0; i < vectors_of(column) * axes_of(column); ++i) {
      fields_.push_back({column.kind, row_bytes_});
      row_bytes_ += column.kind == Column::Kind::word ? word_bytes_ : kNumber_bytes;
    }
  }
  row_type_ += "]";
}

void Table::append_csv(const TableRows& rows, fmt::memory_buffer& out) const {
  append(csv_, rows, out);
}

void Table::append_json(const TableRows& rows, fmt::memory_buffer& out) const {
  append(json_, rows, out);
}

std::string Table::json_line(const TableRows& row) const {
  fmt::memory_buffer text;
  append_json(row, text);
  return {text.data(), text.size() - 1};
}

/// Text before a cell is copied in one piece of constant length, which processors do at once. A
/// number that is that of the row before is not formatted again: a block keeps its velocity until
/// it is hit.
void Table::append(const Text& text, const TableRows& rows, fmt::memory_buffer& out) {
  constexpr std::size_t kPiece_bytes = Piece::kMost_bytes;
  DecimalCounter index(rows.is_infinite ? "infinite" : rows.first.get_str());
  const std::size_t most = std::max(text.most_bytes, index.text().size() + 1);
  const std::size_t begin = out.size();
  out.resize(begin + rows.size * (text.cells.size() * (kPiece_bytes + most) + kPiece_bytes));
  char* end = out.data() + begin;  // fmt writes to a plain pointer a fifth faster
  std::vector<std::string_view> before(text.cells.size());
  const auto add = [&](std::string_view piece) {
    std::memcpy(end, piece.data(), piece.size());
    end += piece.size();
  };
  for (std::size_t row = 0; row < rows.size; ++row, index.increment()) {
    auto last = before.begin();
    for (const Cell& cell : text.cells) {
      std::memcpy(end, cell.before.bytes.data(), kPiece_bytes);
      end += cell.before.size;
      if (cell.kind != Column::Kind::number) {
        const bool is_word = cell.kind == Column::Kind::word;
        add(is_word ? text.words[rows.words[cell.place][row]] : index.text());
        ++last;
        continue;
      }
      const double* const number = rows.numbers[cell.place] + row;
      char* const start = end;
      if (row > 0 && number[0] == number[-1]) {
        std::memmove(end, last->data(), kPiece_bytes);
        end += last->size();
      } else {
        end = fmt::format_to(end, FMT_COMPILE("{}"), shown(*number));
      }
      *last++ = {start, std::size_t(end - start)};
    }
    std::memcpy(end, text.end.bytes.data(), kPiece_bytes);
    end += text.end.size;
  }
  out.resize(static_cast<std::size_t>(end - out.data()));
}

std::string Table::npy_header(const Integer& first, const Integer& count) const {
  for (const Integer& index : {first, Integer(first + count - 1)}) {
    if (count == 0 || abs(index) <= to_integer(std::numeric_limits<std::int64_t>::max())) continue;
    throw UsageError(fmt::format("log: index {} does not fit in 64 bits of npy; use csv or jsonl",
                                 readable(index)));
  }
  constexpr std::size_t kAlignment_bytes = 64;  // of the first row
  std::string text = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({},), }}",
                                 row_type_, count.get_str());
  std::string header("\x93NUMPY\x01\x00", 8);
  const std::size_t length = header.size() + 2 + text.size() + 1;  // with its own length, and '\n'
  text.append((kAlignment_bytes - length % kAlignment_bytes) % kAlignment_bytes, ' ');
  text += '\n';
  header += static_cast<char>(text.size() % 256);
  header += static_cast<char>(text.size() / 256);
  return header + text;
}

/// Four columns at once, each as values of eight bytes. Of a word that is shorter, the next
/// column, which is written later, covers the rest.
void Table::write_npy(const TableRows& rows, char* at) const {
  constexpr std::size_t kAtOnce = 4;
  const std::size_t made_columns = fields_.size() - rows.numbers.size();
  const auto made = std::make_unique_for_overwrite<std::uint64_t[]>(made_columns * rows.size);
  std::uint64_t* values = made.get();
  std::vector<const void*> columns;
  auto number = rows.numbers.begin();
  auto word = rows.words.begin();
  for (const Field& field : fields_) {
    if (field.kind == Column::Kind::number) {
      columns.push_back(*number++);
      continue;
    }
    columns.push_back(values);
    if (field.kind == Column::Kind::index) {
      std::iota(values, values + rows.size, std::uint64_t(rows.first.get_si()));
    } else {
      std::transform(*word, *word + rows.size, values,
                     [words = words_.data()](std::uint32_t place) { return words[place]; });
      ++word;
    }
    values += rows.size;
  }
  for (std::size_t i = 0; i < columns.size();) {
    const bool are_many = columns.size() - i >= kAtOnce;
    (are_many ? write_columns<kAtOnce> : write_columns<1>)(columns.data() + i, fields_.data() + i,
                                                           rows.size, row_bytes_, at);
    i += are_many ? kAtOnce : 1;
  }
}

}  // namespace piblocks
