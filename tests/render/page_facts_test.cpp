// What a page is told of the run, beside what the log says.
#include <gtest/gtest.h>
#include <piblocks/run.hpp>

#include <algorithm>
#include <sstream>

#include "render/video_facts.hpp"

namespace piblocks {
namespace {

/// The text of the string or number behind `"name":`, from `start` on.
std::string value_of(const std::string& json, const std::string& name, std::size_t start = 0) {
  const std::string key = '"' + name + "\":";
  const std::size_t at = json.find(key, start);
  if (at == std::string::npos) return "no " + name;
  const std::size_t begin = at + key.size();
  if (json[begin] == '"') return json.substr(begin + 1, json.find('"', begin + 1) - begin - 1);
  return json.substr(begin, json.find_first_of(",}", begin) - begin);
}

std::vector<Integer> numbers_of(const std::string& text) {
  std::vector<Integer> numbers;
  Integer value = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t mark = word.find('~');
    const Integer difference(word.substr(0, mark));
    const long times = mark == std::string::npos ? 1 : std::stol(word.substr(mark + 1));
    for (long i = 0; i < times; ++i) {
      value += difference;
      numbers.push_back(value);
    }
  }
  return numbers;
}

struct Told {
  explicit Told(const Scene& wanted)
      : scene(wanted), log(scene), schedule(make_schedule(scene, log.timeline())) {
    const PageFacts facts(scene, log, schedule);
    facts.write([this](std::string_view text) { json += text; });
    most = facts.most();
    counts = numbers_of(value_of(json, "counts"));
  }

  Scene scene;
  RunLog log;
  Schedule schedule;
  std::string json;
  Integer most;
  std::vector<Integer> counts;
};

Scene scene_of(int digits) {
  Scene scene;
  scene.system = article_system(digits);
  return scene;
}

void expect_counts_of_frames(const Told& told) {
  ASSERT_EQ(static_cast<std::int64_t>(told.counts.size()), film_frames(told.schedule));
  for (std::size_t frame = 0; frame < told.counts.size(); ++frame) {
    const Rational time = told.schedule.time_of(static_cast<std::int64_t>(frame));
    ASSERT_EQ(told.counts[frame], told.log.timeline().count_at(time)) << frame;
  }
}

/// The lists name these collisions, and their times to the last decimal.
void expect_listed(const Told& told, const std::vector<CollisionRange>& ranges) {
  const Rational unit = 1 / power(10, std::stoul(value_of(told.json, "scale")));
  std::size_t at = told.json.find("\"lists\"");
  for (const CollisionRange& range : ranges) {
    at = told.json.find("{\"first\"", at + 1);
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(Integer(value_of(told.json, "first", at)), range.first);
    const std::vector<Integer> times = numbers_of(value_of(told.json, "times", at));
    ASSERT_EQ(Integer(times.size()), range.last - range.first + 1);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const Rational time = to_rational(told.log.timeline().collision_time(range.first + i));
      ASSERT_LE(abs(times[i] * unit - time), unit / 2) << i;
    }
  }
  EXPECT_EQ(told.json.find("{\"first\"", at + 1), std::string::npos);
}

TEST(PageFacts, HoldsTheCountOfEveryFrameAtAnySize) {
  for (const int digits : {1, 3, 20, 60}) {
    const Told told(scene_of(digits));
    expect_counts_of_frames(told);
    EXPECT_EQ(told.most, told.log.timeline().size());
    EXPECT_LT(told.json.size(), 500'000U) << digits;
  }
}

TEST(PageFacts, ListsAllCollisionsIfTheyAreFew) {
  expect_listed(Told(scene_of(1)), {{1, 3}});
  expect_listed(Told(scene_of(4)), {{1, 3141}});
}

TEST(PageFacts, ListsTheFirstAndTheLastOfMany) {
  expect_listed(Told(scene_of(5)), {{1, 2000}, {29416, 31415}});
  const Integer all("31415926535897932384");
  expect_listed(Told(scene_of(20)), {{1, 2000}, {all - 1999, all}});
}

TEST(PageFacts, ListsOnlyWhatTheVideoShows) {
  Scene scene = scene_of(3);
  scene.time.from = parse_rational("3.45");
  scene.time.to = parse_instant("3.55");
  const Told told(scene);
  EXPECT_GT(told.counts.front(), 1);
  EXPECT_LT(told.counts.back(), 314);
  expect_listed(told, {{told.counts.front() + 1, told.counts.back()}});
  expect_counts_of_frames(told);
}

TEST(PageFacts, ListsCollisionsBeforeTimeZero) {
  Scene scene = scene_of(2);
  scene.system.red.velocity = 1;
  scene.time.from = Rational(-100);
  scene.time.to = Rational(1);
  const Told told(scene);
  EXPECT_EQ(told.counts.front(), -31);
  EXPECT_EQ(told.counts.back(), 0);
  expect_counts_of_frames(told);
  expect_listed(told, {{-30, 0}});
}

TEST(PageFacts, KnowsHowFarALoopGoesForth) {
  Scene scene = scene_of(2);
  scene.pacing.loop = true;
  const Told told(scene);
  const std::int64_t forth = std::stoll(value_of(told.json, "forth"));
  EXPECT_EQ(2 * forth - 2, film_frames(told.schedule));
  EXPECT_EQ(value_of(told.json, "loop"), "true");
  expect_counts_of_frames(told);
  const auto latest = std::ranges::max_element(told.counts);
  EXPECT_LT(latest - told.counts.begin(), forth);
  for (std::int64_t frame = 1; frame < forth; ++frame) {
    EXPECT_GT(told.schedule.time_of(frame), told.schedule.time_of(frame - 1));
  }
  EXPECT_LT(told.schedule.time_of(forth), told.schedule.time_of(forth - 1));
}

TEST(PageFacts, ListedCollisionsAreNeverTwice) {
  for (const int count : {1, 3999, 4000, 4001, 4002}) {
    const auto ranges = listed_collisions(10, 10 + count);
    EXPECT_EQ(ranges.size(), count <= 4000 ? 1U : 2U) << count;
    EXPECT_EQ(ranges.front().first, 11);
    EXPECT_EQ(ranges.back().last, 10 + count);
    EXPECT_TRUE(ranges.size() == 1 || ranges.back().first > ranges.front().last) << count;
  }
  EXPECT_TRUE(listed_collisions(7, 7).empty());
  EXPECT_EQ(listed_collisions(-5, 0).front().first, -4);
}

}  // namespace
}  // namespace piblocks
