#include "media/output/shard_file.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <limits>

#include "support/decode_video.hpp"
#include "support/property.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::file_contents;
using testing_support::TemporaryFolder;

const ShardHeader kHeader = {{"scene", "one: two"}, {"frames", "7"}, {"nothing", ""}};

EncodedChunk random_chunk(Random& random) {
  EncodedChunk chunk(static_cast<std::size_t>(random.integer(0, 5)));
  for (Packet& packet : chunk) {
    packet.bytes.resize(static_cast<std::size_t>(random.integer(0, 40)));
    for (auto& byte : packet.bytes) byte = static_cast<std::uint8_t>(random.integer(0, 255));
    packet.pts = random.integer(-3, 1'000'000);
    packet.dts = random.integer(0, 1) == 0 ? std::numeric_limits<std::int64_t>::min() : packet.pts;
    packet.key_frame = random.integer(0, 1) == 0;
  }
  return chunk;
}

bool equal(const EncodedChunk& one, const EncodedChunk& other) {
  return std::ranges::equal(one, other, [](const Packet& a, const Packet& b) {
    return a.bytes == b.bytes && a.pts == b.pts && a.dts == b.dts && a.key_frame == b.key_frame;
  });
}

/// Hands out packets one by one.
class Packets final : public PacketSource {
 public:
  explicit Packets(const EncodedChunk& packets) : packets_(packets) {}
  std::optional<Packet> next() override {
    if (next_ == packets_.size()) return std::nullopt;
    return packets_[next_++];
  }

 private:
  const EncodedChunk& packets_;
  std::size_t next_ = 0;
};

void write(const std::string& path, const EncodedChunk& sound,
           const std::vector<EncodedChunk>& chunks) {
  const auto sink = open_shard(path, kHeader);
  Packets packets(sound);
  sink->take_sound(packets);
  for (const EncodedChunk& chunk : chunks) sink->append(chunk);
  sink->finish();
}

/// A record's kind, number of packets and checksum.
constexpr std::size_t kRecord_bytes = 1 + 4 + 4;

/// Packets in a record, each with pts, dts, key frame and size.
std::size_t bytes_of(const EncodedChunk& packets) {
  std::size_t bytes = 0;
  for (const Packet& packet : packets) bytes += 8 + 8 + 1 + 4 + packet.bytes.size();
  return bytes;
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void read_all(const std::string& path) {
  ShardReader reader(path);
  while (reader.next()) {
  }
}

EncodedChunk sound_in(const std::string& path) {
  ShardReader reader(path);
  EncodedChunk sound;
  while (const auto packets = reader.next_sound()) {
    sound.insert(sound.end(), packets->begin(), packets->end());
  }
  return sound;
}

/// More than one record holds.
EncodedChunk random_sound(Random& random, std::size_t packets) {
  EncodedChunk sound;
  while (sound.size() < packets) {
    for (Packet& packet : random_chunk(random)) sound.push_back(std::move(packet));
  }
  return sound;
}

TEST(ShardFile, HoldsWhatWasWrittenAndPassesOverSound) {
  const TemporaryFolder folder;
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    std::vector<EncodedChunk> chunks(static_cast<std::size_t>(random.integer(0, 6)));
    for (EncodedChunk& chunk : chunks) chunk = random_chunk(random);
    const EncodedChunk sound = random_sound(random, i % 2 == 0 ? 0 : 10 * std::size_t(i));
    write(folder / "a", sound, chunks);
    EXPECT_TRUE(equal(sound_in(folder / "a"), sound));
    ShardReader reader(folder / "a");
    EXPECT_EQ(reader.header(), kHeader);
    for (const EncodedChunk& chunk : chunks) {
      const auto read = reader.next();
      ASSERT_TRUE(read.has_value());
      EXPECT_TRUE(equal(*read, chunk));
    }
    EXPECT_FALSE(reader.next().has_value());
  }
}

TEST(ShardFile, NoticesThatItWasCutOffAnywhere) {
  const TemporaryFolder folder;
  Random random(2);
  const EncodedChunk sound = random_sound(random, 3);
  write(folder / "whole", sound, {random_chunk(random), random_chunk(random)});
  const std::string whole = file_contents(folder / "whole");
  const std::size_t end_of_sound = whole.find("\n\n") + 2 + kRecord_bytes + bytes_of(sound);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_text(folder / "cut", whole.substr(0, size));
    EXPECT_THROW(read_all(folder / "cut"), Error) << size;
    if (size < end_of_sound) {
      EXPECT_THROW(sound_in(folder / "cut"), Error) << size;
    }
  }
}

TEST(ShardFile, NoticesThatOneBitHasChanged) {
  const TemporaryFolder folder;
  Random random(3);
  const EncodedChunk sound = random_sound(random, 3);
  write(folder / "whole", sound, {random_chunk(random), random_chunk(random)});
  const std::string whole = file_contents(folder / "whole");
  const std::size_t end_of_sound = whole.find("\n\n") + 2 + kRecord_bytes + bytes_of(sound);
  for (std::size_t at = whole.find("\n\n") + 2; at < whole.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ (1 << bit));
      write_text(folder / "changed", changed);
      EXPECT_THROW(read_all(folder / "changed"), Error) << at << ", " << bit;
      if (at < end_of_sound) {
        EXPECT_THROW(sound_in(folder / "changed"), Error) << at << ", " << bit;
      }
    }
  }
}

TEST(ShardFile, IsToldFromOtherFiles) {
  const TemporaryFolder folder;
  for (const std::string text : {"", "\n", "piblocks part 2\n\nE", "piblocks part 1", "PNG",
                                 "piblocks part 1\nno colon\n\nE"}) {
    write_text(folder / "other", text);
    EXPECT_THROW(ShardReader(folder / "other"), UsageError) << text;
  }
  write_text(folder / "long", "piblocks part 1\n" + std::string(5'000'000, 'a'));
  EXPECT_THROW(ShardReader(folder / "long"), UsageError);
  EXPECT_THROW(ShardReader(folder / "none"), UsageError);
  EXPECT_THROW(ShardReader(folder.path()), UsageError);
}

TEST(ShardFile, RefusesWhatIsNoLine) {
  const TemporaryFolder folder;
  for (const auto& [name, value] : {std::pair{"title", "two\nlines"},
                                    {"title", "one line\n"},
                                    {"two\nlines", ""},
                                    {"a: b", "c"}}) {
    EXPECT_THROW(open_shard(folder / "a", {{"fine", "fine"}, {name, value}}), UsageError) << name;
  }
  EXPECT_TRUE(folder.is_empty());
}

TEST(ShardFile, TakesNoMemoryForSizesThatAFileOnlyClaims) {
  const TemporaryFolder folder;
  const std::string packet = std::string(17, '\0') + "\xff\xff\xff\xff";
  write_text(folder / "a",
             "piblocks part 1\n\nC" + std::string("\xff\xff\xff\xff", 4) + packet + "bytes");
  EXPECT_THROW(read_all(folder / "a"), IoError);
}

}  // namespace
}  // namespace piblocks
