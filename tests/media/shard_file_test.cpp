#include "media/output/shard_file.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <limits>

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

class DamagedShard : public testing::Test {
 protected:
  DamagedShard() {
    Random random(2);
    const EncodedChunk sound = random_sound(random, 3);
    write(folder_ / "whole", sound, {random_chunk(random), random_chunk(random)});
    whole_ = file_contents(folder_ / "whole");
    first_record_ = whole_.find("\n\n") + 2;
    end_of_sound_ = first_record_ + kRecord_bytes + bytes_of(sound);
  }
  /// @param at  where the damage begins
  void expect_noticed(const std::string& bytes, std::size_t at) const {
    folder_.save("damaged", bytes);
    EXPECT_THROW(read_all(folder_ / "damaged"), Error) << at;
    if (at < end_of_sound_) {
      EXPECT_THROW(sound_in(folder_ / "damaged"), Error) << at;
    }
  }

  TemporaryFolder folder_;
  std::string whole_;
  std::size_t first_record_ = 0;
  std::size_t end_of_sound_ = 0;
};

TEST_F(DamagedShard, ThatIsCutOffAnywhereIsNoticed) {
  for (std::size_t size = 0; size < whole_.size(); ++size) {
    expect_noticed(whole_.substr(0, size), size);
  }
}

TEST_F(DamagedShard, WithOneOtherBitIsNoticed) {
  for (std::size_t at = first_record_; at < whole_.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string changed = whole_;
      changed[at] = static_cast<char>(changed[at] ^ (1 << bit));
      expect_noticed(changed, at);
    }
  }
}

TEST(ShardFile, IsToldFromOtherFiles) {
  const TemporaryFolder folder;
  for (const std::string text : {"", "\n", "piblocks part 2\n\nE", "piblocks part 1", "PNG",
                                 "piblocks part 1\nno colon\n\nE"}) {
    folder.save("other", text);
    EXPECT_THROW(ShardReader(folder / "other"), UsageError) << text;
  }
  folder.save("long", "piblocks part 1\n" + std::string(5'000'000, 'a'));
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
  folder.save("a", "piblocks part 1\n\nC" + std::string("\xff\xff\xff\xff", 4) + packet + "bytes");
  EXPECT_THROW(read_all(folder / "a"), IoError);
}

}  // namespace
}  // namespace piblocks
