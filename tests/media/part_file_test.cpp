#include "media/part_file.hpp"

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

const PartHeader kHeader = {{"scene", "one: two"}, {"frames", "7"}, {"nothing", ""}};

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

void write(const std::string& path, const std::vector<EncodedChunk>& chunks) {
  const auto sink = open_part(path, kHeader);
  for (const EncodedChunk& chunk : chunks) sink->append(chunk);
  sink->finish();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void read_all(const std::string& path) {
  PartReader reader(path);
  while (reader.next()) {
  }
}

TEST(PartFile, HoldsWhatWasWritten) {
  const TemporaryFolder folder;
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    std::vector<EncodedChunk> chunks(static_cast<std::size_t>(random.integer(0, 6)));
    for (EncodedChunk& chunk : chunks) chunk = random_chunk(random);
    write(folder / "a", chunks);
    PartReader reader(folder / "a");
    EXPECT_EQ(reader.header(), kHeader);
    for (const EncodedChunk& chunk : chunks) {
      const auto read = reader.next();
      ASSERT_TRUE(read.has_value());
      EXPECT_TRUE(equal(*read, chunk));
    }
    EXPECT_FALSE(reader.next().has_value());
  }
}

TEST(PartFile, NoticesThatItWasCutOffAnywhere) {
  const TemporaryFolder folder;
  Random random(2);
  write(folder / "whole", {random_chunk(random), random_chunk(random)});
  const std::string whole = file_contents(folder / "whole");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_text(folder / "cut", whole.substr(0, size));
    EXPECT_THROW(read_all(folder / "cut"), Error) << size;
  }
}

TEST(PartFile, NoticesThatOneBitHasChanged) {
  const TemporaryFolder folder;
  Random random(3);
  write(folder / "whole", {random_chunk(random), random_chunk(random)});
  const std::string whole = file_contents(folder / "whole");
  for (std::size_t at = whole.find("\n\n") + 2; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << random.integer(0, 7)));
    write_text(folder / "changed", changed);
    EXPECT_THROW(read_all(folder / "changed"), Error) << at;
  }
}

TEST(PartFile, IsToldFromOtherFiles) {
  const TemporaryFolder folder;
  for (const std::string text : {"", "\n", "piblocks part 2\n\nE", "piblocks part 1", "PNG",
                                 "piblocks part 1\nno colon\n\nE"}) {
    write_text(folder / "other", text);
    EXPECT_THROW(PartReader(folder / "other"), UsageError) << text;
  }
  write_text(folder / "long", "piblocks part 1\n" + std::string(5'000'000, 'a'));
  EXPECT_THROW(PartReader(folder / "long"), UsageError);
  EXPECT_THROW(PartReader(folder / "none"), UsageError);
  EXPECT_THROW(PartReader(folder.path()), UsageError);
}

TEST(PartFile, RefusesWhatIsNoLine) {
  const TemporaryFolder folder;
  for (const auto& [name, value] : {std::pair{"title", "two\nlines"},
                                    {"title", "one line\n"},
                                    {"two\nlines", ""},
                                    {"a: b", "c"}}) {
    EXPECT_THROW(open_part(folder / "a", {{"fine", "fine"}, {name, value}}), UsageError) << name;
  }
  EXPECT_TRUE(folder.is_empty());
}

TEST(PartFile, TakesNoMemoryForSizesThatAFileOnlyClaims) {
  const TemporaryFolder folder;
  const std::string packet = std::string(17, '\0') + "\xff\xff\xff\xff";
  write_text(folder / "a",
             "piblocks part 1\n\nC" + std::string("\xff\xff\xff\xff", 4) + packet + "bytes");
  EXPECT_THROW(read_all(folder / "a"), IoError);
}

}  // namespace
}  // namespace piblocks
