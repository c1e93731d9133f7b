// Tables: rows of named columns as CSV, JSON and NumPy have them.
// In: a layout, and rows, column by column. Out: text, in which every number reads back as the same
// double; bytes.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

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

struct TableLayout {
  enum class Kind : std::uint8_t {
    number,  ///< a double
    index,   ///< a whole number of any size, one more in each row
    word     ///< one of a few words, by its place in the list
  };
  struct Column {
    std::string name;
    Kind kind = Kind::number;
  };
  struct Word {
    std::string csv;
    std::string json;
    std::string npy;  ///< at most 8 bytes, as many as other words have
  };

  std::vector<Column> columns = {};  ///< as in NumPy's rows; the last one is no word
  std::string npy = {};   ///< their types, as NumPy's description has them between brackets
  std::string csv = {};   ///< "<time>,<kind>": where the values of columns go
  std::string json = {};  ///< an object with the same
  std::vector<Word> words = {};
};

/// Rows one after another, in memory of somebody else.
struct TableRows {
  Integer first = 0;         ///< the index of row 0
  bool is_infinite = false;  ///< whether that index stands for infinitely many, as text says
  std::size_t size = 0;
  /// Of each column one value a row: doubles; places of words as std::uint32_t; nullptr of an
  /// index.
  std::vector<const void*> columns = {};
};

enum class TableFormat : std::uint8_t { csv, jsonl, npy };

/// Immutable and thread-safe.
class Table {
 public:
  /// @param layout  whose `csv` and `json` name columns that there are
  explicit Table(TableLayout layout);

  /// What comes before so many rows.
  /// @throws UsageError if an index does not fit into 64 bits of NumPy.
  std::string header(TableFormat format, const Integer& first, const Integer& count) const;
  /// Appends the rows. @throws SimulationError as shown()
  void append(TableFormat format, const TableRows& rows, fmt::memory_buffer& out) const;

  /// A row as NumPy describes it: without gaps, little-endian.
  std::string row_type() const { return '[' + layout_.npy + ']'; }
  std::size_t row_bytes() const noexcept { return row_bytes_; }
  /// Writes row_bytes() each. An index that does not fit loses its upper bits.
  void write_npy(const TableRows& rows, char* at) const;

 private:
  /// A text of at most 32 bytes; copying all of them takes less time than asking how many.
  struct Piece {
    std::array<char, 32> bytes = {};
    std::size_t size = 0;
  };
  /// A value and the text before it.
  struct Cell {
    Piece before;
    std::size_t column = 0;
    TableLayout::Kind kind = TableLayout::Kind::number;
  };
  /// A row as text.
  struct RowText {
    std::vector<Cell> cells = {};
    Piece end = {};
    std::vector<std::string> words = {};
    std::size_t most_bytes = 0;  ///< without the index
  };

  static Piece piece_of(std::string_view text);
  RowText row_text(std::string_view row, std::string TableLayout::Word::*word) const;
  static void append_text(const RowText& text, const TableRows& rows, fmt::memory_buffer& out);

  TableLayout layout_;
  RowText csv_;
  RowText json_;
  std::size_t row_bytes_ = 0;
  std::vector<std::size_t> places_bytes_ = {};  ///< of the columns in a row of NumPy
  std::size_t made_columns_ = 0;                ///< all but those of numbers
  std::vector<std::uint64_t> words_ = {};       ///< as NumPy has them
};

}  // namespace piblocks
