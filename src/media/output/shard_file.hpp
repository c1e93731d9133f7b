// Chunks on their way from one machine to another.
// In: chunks, and the description of their job. Out: a file, and from it the same chunks.
//
// The file starts with lines of text: "piblocks part 1", then "NAME: VALUE" each, then an empty
// line. Records follow, with numbers in little-endian order: a byte for the kind, the number of
// packets (32 bits), the packets, and the CRC-32 of all these. A packet is its pts and dts (64 bits
// each), a byte that is 1 for a key frame, its size (32 bits) and its bytes. Records of the kind
// 'S' have the sound of the whole output and come first; a record 'C' is a chunk. A byte 'E' ends
// the file and shows that it was not cut off.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include "media/output/output.hpp"

namespace piblocks {

/// Names and values, in order. Neither has a line break, and a name has no colon.
using ShardHeader = std::vector<std::pair<std::string, std::string>>;

/// The lines "NAME: VALUE".
std::string text_of(const ShardHeader& header);

/// Whether there is a file of this name that is a part file of any version.
bool is_shard_file(const std::string& path);

/// A sink that stores chunks as they are.
/// @param overwrite  whether it may replace a file that is no part file.
/// @throws UsageError if the file cannot be opened, would replace another kind of file, or has a
///         header that cannot be written as lines.
std::unique_ptr<FrameSink> open_shard(const std::string& path, const ShardHeader& header,
                                      bool overwrite = false);

/// Reads a part file, chunk by chunk. Takes no more memory than the file is long.
class ShardReader {
 public:
  /// @throws UsageError if the file cannot be opened or is not a part file.
  explicit ShardReader(std::string path);

  const ShardHeader& header() const noexcept { return header_; }
  /// The next chunk; nothing after the last. @throws IoError if the file is damaged or cut off.
  std::optional<EncodedChunk> next();
  /// The next packets of sound; nothing after the last. Do not mix with next().
  /// @throws IoError as next().
  std::optional<EncodedChunk> next_sound();

 private:
  struct Record {
    std::uint8_t kind;
    EncodedChunk packets;
  };

  std::optional<Record> next_record();
  void read_header();
  /// A line without its end; nothing if it is longer or has no end.
  std::optional<std::string> read_line(std::size_t max_bytes);
  Bytes read(std::uint64_t count);
  [[noreturn]] void fail_to_read() const;
  [[noreturn]] void fail_damaged() const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t left_bytes_ = 0;
  ShardHeader header_;
};

}  // namespace piblocks
