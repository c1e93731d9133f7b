#include "core/nearest_name.hpp"

#include <gtest/gtest.h>

#include <random>

namespace piblocks {
namespace {

const std::vector<std::string> kNames = {"lecture",    "lecture-light", "dark", "masses",
                                         "velocities", "view.size",     "csv",  "jsonl"};

TEST(NearestName, FindsWhatWasMeant) {
  const std::pair<const char*, const char*> cases[] = {
      {"lecure", "lecture"},      {"letcure", "lecture"},
      {"LECTURE", "lecture"},     {"lecture_light", "lecture-light"},
      {"mases", "masses"},        {"velcities", "velocities"},
      {"vel", "velocities"},      {"json", "jsonl"},
      {"view.siez", "view.size"}, {"veiw.size", "view.size"},
      {"drak", "dark"},           {"cvs", "csv"}};
  for (const auto& [word, meant] : cases) EXPECT_EQ(nearest_name(word, kNames), meant) << word;
}

TEST(NearestName, IsNoneOfWordsThatAreUnlike) {
  for (const char* word : {"", "x", "quux", "le", "light", "mssses.x.y", "-", "0"}) {
    EXPECT_EQ(nearest_name(word, kNames), "") << word;
  }
  EXPECT_EQ(nearest_name("lecture", {}), "");
  EXPECT_EQ(nearest_name(std::string(41, 'a'), {std::string(41, 'a') + 'b'}), "");
}

/// Any one mistake in a name of some length is understood.
TEST(NearestName, ForgivesAnyOneMistake) {
  std::mt19937 random(7);
  for (const std::string& name : kNames) {
    if (name.size() < 5) continue;
    for (std::size_t at = 0; at + 1 < name.size(); ++at) {
      std::string missing = name;
      missing.erase(at, 1);
      std::string swapped = name;
      std::swap(swapped[at], swapped[at + 1]);
      std::string other = name;
      other[at] = static_cast<char>('a' + random() % 26);
      std::string more = name;
      more.insert(at, 1, 'q');
      for (const std::string& word : {missing, swapped, other, more}) {
        EXPECT_EQ(nearest_name(word, kNames), name) << word;
      }
    }
  }
}

TEST(MustBeOneOf, NamesAllAndTheNearest) {
  EXPECT_EQ(must_be_one_of("ture", {"true", "false"}),
            "must be true or false; did you mean 'true'?");
  EXPECT_EQ(must_be_one_of("xml", {"csv", "jsonl", "npy"}), "must be one of: csv, jsonl, npy");
  EXPECT_EQ(must_be_one_of("", {"a", "b", "c"}), "must be one of: a, b, c");
}

}  // namespace
}  // namespace piblocks
