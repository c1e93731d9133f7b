// Tables: named columns, and their rows as CSV, JSON and NumPy have them.
// In: columns; then rows, column by column. Out: text, in which every number reads back as the same
// double; bytes.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

/// A number as it is printed: -0 becomes 0.
/// @throws SimulationError if it is not finite: JSON has no infinity.
inline double shown(double value) {
  if (!std::isfinite(value)) {
    throw SimulationError("output: a number is beyond the range of a double (about 1.8e308)");
  }
  return value == 0 ? 0 : value;
}

/// A column of a table. In JSON, columns of one key are an object, whose inner keys are in
/// alphabetical order.
struct Column {
  enum class Kind : std::uint8_t {
    index,   ///< a whole number of any size, one more in each row
    number,  ///< a vector, or a list of vectors
    word     ///< one of the words of the table
  };
  std::string name;  ///< in NumPy and, of a single number, in CSV
  Kind kind = Kind::number;
  std::string key = name;  ///< in JSON; without one, only NumPy has the column
  std::string inner_key = {};
  std::vector<std::string> axes = {};  ///< names in CSV of the coordinates, if there are several
  std::size_t vectors = 0;             ///< length of the list; 0: no list. CSV has no lists
};

/// What a column of words has, as each format writes it.
struct Word {
  std::string csv;
  std::string json;
  std::string numpy;  ///< bytes, at most 8 and as many in all words
};

struct Words {
  std::string type = {};  ///< in NumPy, such as "|S6"
  std::vector<Word> list = {};
};

/// Rows one after another. Who fills them keeps the memory.
struct TableRows {
  Integer first = 0;         ///< the index of row 0
  bool is_infinite = false;  ///< whether this index stands for infinitely many
  std::size_t size = 0;
  std::vector<const double*> numbers = {};  ///< for each number of a row, its column
  std::vector<const std::uint32_t*> words =
      {};  ///< the same for words, by their places in the list
};

/// Immutable and thread-safe.
class Table {
 public:
  explicit Table(const std::vector<Column>& columns, const Words& words = {});

  /// The first line of CSV.
  const std::string& csv_header() const noexcept { return csv_.begin; }
  /// A line for each row. @throws SimulationError as shown()
  void append_csv(const TableRows& rows, fmt::memory_buffer& out) const;
  void append_json(const TableRows& rows, fmt::memory_buffer& out) const;
  /// The same without the end of the line. @param row  one
  std::string json_line(const TableRows& row) const;

  /// What a file of NumPy begins with, for so many rows
  /// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0).
  /// @throws UsageError if an index does not fit into 64 bits.
  std::string npy_header(const Integer& first, const Integer& count) const;
  /// A row as NumPy describes it: without gaps, little-endian.
  const std::string& row_type() const noexcept { return row_type_; }
  std::size_t row_bytes() const noexcept { return row_bytes_; }
  /// Writes row_bytes() each. An index that does not fit loses its upper bits.
  void write_npy(const TableRows& rows, char* at) const;

 private:
  friend class TextLayout;

  /// A text without memory of its own.
  struct Piece {
    static constexpr std::size_t kMost_bytes = 32;

    std::array<char, kMost_bytes> bytes = {};
    std::size_t size = 0;
  };
  /// A number, word or index of a row, with the text before it.
  struct Cell {
    Piece before;
    Column::Kind kind;
    std::size_t place;  ///< in TableRows::numbers or TableRows::words
  };
  /// How rows are written as text.
  struct Text {
    std::string begin = {};  ///< before all rows
    std::vector<Cell> cells = {};
    Piece end = {};  ///< after each row
    std::vector<std::string> words = {};
    std::size_t most_bytes = 32;  ///< of a word, or of a double as fmt writes it

    void add_word(const std::string& word) {
      words.push_back(word);
      most_bytes = std::max(most_bytes, word.size());
    }
  };

  /// A number, word or index of NumPy's row.
  struct Field {
    Column::Kind kind;
    std::size_t place_bytes;
  };

  static void append(const Text& text, const TableRows& rows, fmt::memory_buffer& out);
  template <std::size_t kColumns>
  static void write_columns(const void* const* columns, const Field* fields, std::size_t rows,
                            std::size_t row_bytes, char* at);

  Text csv_;
  Text json_;
  std::string row_type_;
  std::size_t row_bytes_ = 0;
  std::vector<Field> fields_;         ///< each coordinate for itself
  std::vector<std::uint64_t> words_;  ///< in NumPy
  std::size_t word_bytes_ = 0;
};

}  // namespace piblocks
