// MP4 files as tests read them, without the writer's code.
// In: what the writer writes where. Out: boxes, tables, and the bytes of each picture.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "h264/mp4_writer.hpp"

namespace piblocks::h264 {

using ByteVector = std::vector<std::uint8_t>;

/// A file in memory. It holds no more than its first bytes if it is too large.
class Mp4Memory {
 public:
  explicit Mp4Memory(std::uint64_t kept_bytes = 1 << 28) : kept_bytes_(kept_bytes) {}

  Mp4Writer::WriteAt writer() {
    return [this](std::uint64_t offset, std::span<const std::uint8_t> bytes) {
      const std::uint64_t end = offset + bytes.size();
      const auto after = written.lower_bound(offset);
      EXPECT_TRUE(after == written.end() || after->first >= end) << "written twice: " << offset;
      EXPECT_TRUE(after == written.begin() || std::prev(after)->second <= offset) << offset;
      written[offset] = end;
      size = std::max(size, end);
      if (end > kept_bytes_) return;
      if (bytes_.size() < end) bytes_.resize(end);
      std::ranges::copy(bytes, bytes_.begin() + std::ptrdiff_t(offset));
    };
  }
  const ByteVector& bytes() const { return bytes_; }

  std::map<std::uint64_t, std::uint64_t> written;  ///< begins and ends of what was
  std::uint64_t size = 0;

 private:
  std::uint64_t kept_bytes_;
  ByteVector bytes_;
};

inline std::uint64_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, int size = 4) {
  std::uint64_t value = 0;
  for (int i = 0; i < size; ++i) value = value << 8 | bytes[at + std::size_t(i)];
  return value;
}

/// Boxes by their path, such as "moov/trak/tkhd", with what they contain; the second of a name gets
/// a "'". Of mdat, the content may not be at hand.
struct Mp4Boxes {
  Mp4Boxes(std::span<const std::uint8_t> bytes, std::uint64_t file_size) {
    read(bytes, 0, file_size, "");
  }

  ByteVector at(const std::string& path) const {
    const auto found = contents.find(path);
    EXPECT_NE(found, contents.end()) << path;
    return found == contents.end() ? ByteVector(100) : found->second;
  }
  bool has(const std::string& path) const { return contents.contains(path); }

  std::vector<std::string> order;
  std::map<std::string, ByteVector> contents;
  std::map<std::string, std::uint64_t> starts;  ///< of the contents
  std::map<std::string, std::uint64_t> sizes;   ///< of the contents

 private:
  void read(std::span<const std::uint8_t> bytes, std::uint64_t at, std::uint64_t end,
            const std::string& parent) {
    static const std::set<std::string> kParents = {"moov", "trak", "edts", "mdia",
                                                   "minf", "dinf", "stbl"};
    while (at < end) {
      ASSERT_LE(at + 8, std::min<std::uint64_t>(end, bytes.size()));
      std::uint64_t size = number_at(bytes, at);
      const std::string type(bytes.begin() + std::ptrdiff_t(at) + 4,
                             bytes.begin() + std::ptrdiff_t(at) + 8);
      const std::uint64_t header = size == 1 ? 16 : 8;
      if (size == 1) size = number_at(bytes, at + 8, 8);
      ASSERT_GE(size, header) << type;
      ASSERT_LE(size, end - at) << type;
      std::string path = parent + type;
      while (contents.contains(path)) path += "'";
      order.push_back(path);
      starts[path] = at + header;
      sizes[path] = size - header;
      if (at + size <= bytes.size()) {
        contents[path].assign(bytes.begin() + std::ptrdiff_t(at + header),
                              bytes.begin() + std::ptrdiff_t(at + size));
      }
      if (kParents.contains(type)) read(bytes, at + header, at + size, path + "/");
      at += size;
    }
    EXPECT_EQ(at, end) << parent;
  }
};

/// The tables of a track: "moov/trak", or "moov/trak'", the second one.
inline std::string tables_of(const std::string& track) { return track + "/mdia/minf/stbl/"; }
inline const std::string kTables = tables_of("moov/trak");

struct Sample {
  std::uint64_t offset;
  std::uint64_t size;
  friend bool operator==(const Sample&, const Sample&) = default;
};

/// Where each sample is, by stsc, stco or co64, and stsz.
inline std::vector<Sample> samples_of(const Mp4Boxes& boxes, const std::string& tables = kTables) {
  const ByteVector sizes = boxes.at(tables + "stsz");
  const ByteVector runs = boxes.at(tables + "stsc");
  const bool is_far = boxes.has(tables + "co64");
  const ByteVector offsets = boxes.at(tables + (is_far ? "co64" : "stco"));
  EXPECT_EQ(number_at(sizes, 4), 0u);
  const std::uint64_t count = number_at(sizes, 8);
  EXPECT_EQ(sizes.size(), 12 + 4 * count);
  const std::uint64_t chunks = number_at(offsets, 4);
  EXPECT_EQ(offsets.size(), 8 + (is_far ? 8 : 4) * chunks);
  const std::uint64_t run_count = number_at(runs, 4);
  EXPECT_EQ(runs.size(), 8 + 12 * run_count);
  std::vector<Sample> samples;
  std::uint64_t run = 0;
  for (std::uint64_t chunk = 0; chunk < chunks; ++chunk) {
    if (run + 1 < run_count && number_at(runs, 8 + 12 * (run + 1)) == chunk + 1) ++run;
    std::uint64_t at = number_at(offsets, 8 + (is_far ? 8 : 4) * chunk, is_far ? 8 : 4);
    for (std::uint64_t i = number_at(runs, 12 + 12 * run); i > 0; --i) {
      if (samples.size() == count) {
        ADD_FAILURE() << "chunks of too many samples";
        return samples;
      }
      const std::uint64_t size = number_at(sizes, 12 + 4 * samples.size());
      samples.push_back({at, size});
      at += size;
    }
  }
  EXPECT_EQ(samples.size(), count);
  return samples;
}

/// The numbers in stss, from 0.
inline std::vector<std::size_t> key_frames_of(const Mp4Boxes& boxes) {
  const ByteVector table = boxes.at(kTables + "stss");
  std::vector<std::size_t> numbers;
  for (std::size_t at = 8; at < table.size(); at += 4) numbers.push_back(number_at(table, at) - 1);
  EXPECT_EQ(numbers.size(), number_at(table, 4));
  return numbers;
}

}  // namespace piblocks::h264
