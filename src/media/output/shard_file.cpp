#include "media/output/shard_file.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <zlib.h>

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "core/descriptor.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kMagic = "piblocks part 1";
constexpr std::string_view kAnyMagic = kMagic.substr(0, 14);  // without its version
constexpr std::uint8_t kChunkRecord = 'C';
constexpr std::uint8_t kSoundRecord = 'S';
constexpr std::uint8_t kEndRecord = 'E';
/// Packets in a record of sound.
constexpr std::size_t kSoundPackets = 64;
/// Limits of the header. Numbers of a scene may have 100,000 digits each, and each of its bodies,
/// of which there may be 100,000, has a line.
constexpr std::size_t kMaxHeaderLine_bytes = 4 * 1024 * 1024;
constexpr std::size_t kMaxHeaderLines = 200'000;

// pts, dts, key frame, size.
constexpr std::size_t kPacketHeader_bytes = 8 + 8 + 1 + 4;

void append_packet(Bytes& bytes, const Packet& packet) {
  append_little_endian(bytes, std::uint64_t(packet.pts), 8);
  append_little_endian(bytes, std::uint64_t(packet.dts), 8);
  bytes.push_back(packet.key_frame ? 1 : 0);
  append_little_endian(bytes, packet.bytes.size(), 4);
  append(bytes, packet.bytes);
}

std::uint32_t checksum(std::uint32_t before, const Bytes& bytes) {
  if (bytes.empty()) return before;  // zlib would start again
  return std::uint32_t(crc32_z(before, bytes.data(), bytes.size()));
}

class ShardSink final : public FrameSink {
 public:
  ShardSink(const std::string& path, const ShardHeader& header) : file_(path) {
    file_.write(fmt::format("{}\n", kMagic));
    file_.write(text_of(header) + "\n");
  }

  void take_sound(PacketSource& sound) override {
    EncodedChunk packets;
    while (auto packet = sound.next()) {
      packets.push_back(std::move(*packet));
      if (packets.size() < kSoundPackets) continue;
      write(kSoundRecord, packets);
      packets.clear();
    }
    if (!packets.empty()) write(kSoundRecord, packets);
  }

  void append(const EncodedChunk& chunk) override { write(kChunkRecord, chunk); }

  void finish() override {
    file_.write({&kEndRecord, 1});
    file_.finish();
  }

 private:
  void write(const std::uint8_t& kind, const EncodedChunk& chunk) {
    Bytes bytes;
    append_little_endian(bytes, chunk.size(), 4);
    for (const Packet& packet : chunk) append_packet(bytes, packet);
    append_little_endian(bytes, checksum(checksum(0, {kind}), bytes), 4);
    file_.write({&kind, 1});
    file_.write(bytes);
  }

  OutputFile file_;
};

}  // namespace

bool is_shard_file(const std::string& path) {
  return beginning_of(path, kAnyMagic.size()) == kAnyMagic;
}

std::string text_of(const ShardHeader& header) {
  std::string text;
  for (const auto& [name, value] : header) text += fmt::format("{}: {}\n", name, value);
  return text;
}

std::unique_ptr<FrameSink> open_shard(const std::string& path, const ShardHeader& header,
                                      bool overwrite) {
  if (!overwrite && beginning_of(path, 1) && !is_shard_file(path)) {
    throw UsageError(fmt::format(
        "part: '{}' is there, but not a part file; use another name, or --overwrite to replace it",
        path));
  }
  for (const auto& [name, value] : header) {
    if (name.find_first_of(":\n") == std::string::npos && value.find('\n') == std::string::npos) {
      continue;
    }
    throw UsageError(
        fmt::format("part: cannot write '{}': {} cannot be said in one line", path, name));
  }
  return std::make_unique<ShardSink>(path, header);
}

ShardReader::ShardReader(std::string path) : path_(std::move(path)) {
  std::error_code error;
  left_bytes_ = std::filesystem::file_size(path_, error);
  if (!error) {
    file_.open(path_, std::ios::binary);
    if (!file_) error.assign(errno, std::generic_category());
  }
  if (error) throw UsageError(fmt::format("part: cannot open '{}': {}", path_, error.message()));
  read_header();
}

void ShardReader::read_header() {
  bool is_shard = read_line(kMagic.size()) == kMagic;
  while (is_shard && header_.size() < kMaxHeaderLines) {
    const std::optional<std::string> line = read_line(kMaxHeaderLine_bytes);
    if (line && line->empty()) return;
    const std::size_t colon = line ? line->find(": ") : std::string::npos;
    is_shard = colon != std::string::npos;
    if (is_shard) header_.emplace_back(line->substr(0, colon), line->substr(colon + 2));
  }
  throw UsageError(fmt::format("part: '{}' is no part file of this version", path_));
}

std::optional<std::string> ShardReader::read_line(std::size_t max_bytes) {
  std::string line;
  while (left_bytes_ > 0 && line.size() <= max_bytes) {
    const int byte = file_.get();
    if (!file_) fail_to_read();
    --left_bytes_;
    if (byte == '\n') return line;
    line.push_back(static_cast<char>(byte));
  }
  return std::nullopt;
}

std::optional<EncodedChunk> ShardReader::next() {
  while (auto record = next_record()) {
    if (record->kind == kChunkRecord) return std::move(record->packets);
  }
  return std::nullopt;
}

std::optional<EncodedChunk> ShardReader::next_sound() {
  auto record = next_record();
  if (!record || record->kind != kSoundRecord) return std::nullopt;
  return std::move(record->packets);
}

std::optional<ShardReader::Record> ShardReader::next_record() {
  const std::uint8_t kind = read(1).front();
  if (kind == kEndRecord && left_bytes_ == 0) return std::nullopt;
  if (kind != kChunkRecord && kind != kSoundRecord) fail_damaged();

  const Bytes count = read(4);
  std::uint32_t sum = checksum(checksum(0, {kind}), count);
  EncodedChunk chunk;
  for (auto left = from_little_endian(count); left > 0; --left) {
    const Bytes header = read(kPacketHeader_bytes);
    const auto number = [&](std::size_t at, std::size_t size_bytes) {
      return from_little_endian(ByteSpan(header).subspan(at, size_bytes));
    };
    Bytes bytes = read(number(17, 4));
    sum = checksum(checksum(sum, header), bytes);
    chunk.push_back({.bytes = std::move(bytes),
                     .pts = std::int64_t(number(0, 8)),
                     .dts = std::int64_t(number(8, 8)),
                     .key_frame = header[16] == 1});
  }
  if (from_little_endian(read(4)) != sum) fail_damaged();
  return Record{kind, std::move(chunk)};
}

Bytes ShardReader::read(std::uint64_t count) {
  if (count > left_bytes_) fail_damaged();
  Bytes bytes(count);
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  if (!file_) fail_to_read();
  left_bytes_ -= count;
  return bytes;
}

void ShardReader::fail_to_read() const {
  throw IoError(fmt::format("part: cannot read '{}': {}", path_, error_text(errno)));
}

void ShardReader::fail_damaged() const {
  throw IoError(fmt::format("part: '{}' is damaged or cut off; render it again", path_));
}

}  // namespace piblocks
