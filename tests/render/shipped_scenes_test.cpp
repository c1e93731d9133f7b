// The films that come with the program end on what they promise.
#include <gtest/gtest.h>
#include <piblocks/script.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/text.hpp"
#include "draw/item_parts.hpp"
#include "render/film.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {

namespace fs = std::filesystem;

std::map<std::string, fs::path> shipped_scenes() {
  std::map<std::string, fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(PIBLOCKS_SCENES)) {
    if (entry.path().extension() == ".toml") scenes[entry.path().stem()] = entry.path();
  }
  return scenes;
}

Film film_of_file(const fs::path& file) {
  ScriptBuilder builder;
  builder.read_file(file);
  return Film(builder.build());
}

/// What people read about a scene: its row in the table, its comments, and its quoted texts.
std::string words_about(const std::string& name, const fs::path& file) {
  const std::string readme =
      testing_support::file_contents(fs::path(PIBLOCKS_SCENES) / "README.md");
  const std::string row = "| [" + name + "](";
  std::string words;
  if (const std::size_t at = readme.find(row); at != std::string::npos) {
    words = readme.substr(at, readme.find('\n', at) - at);
  }
  const std::string toml = testing_support::file_contents(file);
  for (const std::regex& part : {std::regex("#[^\n]*"), std::regex("\"[^\"\n]*\"")}) {
    for (std::sregex_iterator found(toml.begin(), toml.end(), part), end; found != end; ++found) {
      words += "\n" + found->str();
    }
  }
  return words;
}

/// The numbers that are said to be counted, without separators.
std::set<std::string> named_counts(const std::string& words) {
  const std::regex claim(
      "([0-9][0-9, and]*) collisions|(?:counts?|collisions count|count is|which is) ([0-9][0-9,]*)|"
      "(?:bounces|collide) ([0-9][0-9,]*) times");
  const std::regex number("[0-9]+(?:,[0-9]{3})*");
  std::set<std::string> counts;
  for (std::sregex_iterator found(words.begin(), words.end(), claim), end; found != end; ++found) {
    const std::string list = (*found)[1].str() + (*found)[2].str() + (*found)[3].str();
    for (std::sregex_iterator one(list.begin(), list.end(), number); one != end; ++one) {
      std::string digits = one->str();
      std::erase(digits, ',');
      counts.insert(std::move(digits));
    }
  }
  return counts;
}

/// What all counters of a picture say, without separators.
std::vector<std::string> counters_of(const std::vector<DrawItem>& items) {
  std::vector<std::string> counts;
  std::string own;  // in pieces where digits light up
  for (const DrawItem& item : items) {
    if (const auto* group = std::get_if<GroupItem>(&item)) {
      std::ranges::move(counters_of(group->list->items), std::back_inserter(counts));
    }
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && text->id >= ItemId::lit_count && text->id < ItemId::pi)
      own += text->text;
  }
  std::erase(own, ',');
  if (!own.empty()) counts.push_back(std::move(own));
  return counts;
}

/// A segment's last picture before it fades, and its runs.
struct Ending {
  std::vector<std::string> counters;
  std::span<const FilmRun> runs;
};

std::vector<Ending> endings_of(const Film& film) {
  std::vector<Ending> endings;
  for (std::size_t i = 0; i < film.segments().size(); ++i) {
    const FilmSegment& segment = film.segments()[i].segment;
    const std::int64_t fade =
        i + 1 < film.segments().size() ? film.segments()[i + 1].fade_frames : 0;
    const DrawList last = segment.frame(segment.frame_count() - 1 - fade);
    endings.push_back({counters_of(last.items), segment.runs()});
  }
  return endings;
}

TEST(ShippedScenes, EndOnTheirLastCollision) {
  // The turn alone; and a rack, of which two slow balls meet long after. All others have an end
  // that is worth waiting for.
  const std::set<std::string> excerpts = {"rack", "slow-turn"};
  int runs = 0;
  for (const auto& [name, file] : shipped_scenes()) {
    if (excerpts.contains(name)) continue;
    SCOPED_TRACE(name);
    const Film film = film_of_file(file);
    for (const auto& [counters, all] : endings_of(film)) {
      ASSERT_EQ(counters.size(), all.size());
      for (std::size_t k = 0; k < all.size(); ++k) {
        const Log& log = all[k].log();
        if (log.never_ends()) continue;
        if (counters[k] == "0") continue;  // a question, not an answer
        EXPECT_EQ(counters[k], log.last().get_str(all[k].scene().show.base)) << "run " << k;
        ++runs;
      }
    }
  }
  EXPECT_GT(runs, 30);
}

TEST(ShippedScenes, ShowTheNumbersThatTheyName) {
  std::set<std::string> all_named;
  for (const auto& [name, file] : shipped_scenes()) {
    SCOPED_TRACE(name);
    const Film film = film_of_file(file);
    std::set<std::string> shown;
    for (const auto& [counters, runs] : endings_of(film)) {
      shown.insert(counters.begin(), counters.end());
      for (const FilmRun& run : runs) {
        // What is written in another base is named in both.
        if (run.scene().show.base != 10) shown.insert(run.log().last().get_str());
        // Collisions that never end pass the number that is named.
        if (!run.log().never_ends()) continue;
        for (std::int64_t k = 0; k < film.frame_count(); ++k) {
          for (std::string& count : counters_of(film.frame(k).items)) shown.insert(count);
        }
      }
    }
    for (const std::string& count : named_counts(words_about(name, file))) {
      EXPECT_TRUE(shown.contains(count)) << count;
      all_named.insert(count);
    }
  }
  for (const char* number : {"3", "30", "31", "314", "31415", "110010", "31415926535897932384"}) {
    EXPECT_TRUE(all_named.contains(number)) << number << " is named by no scene";
  }
}

Film shipped(const std::string& name) { return film_of_file(shipped_scenes().at(name)); }

std::vector<double> last_velocities(const Log& log) {
  std::vector<double> velocities;
  for (const Motion& motion : log.state_at(log.time_after(log.last())).bodies) {
    velocities.push_back(motion.velocity[0]);
  }
  return velocities;
}

TEST(ShippedScenes, CartsPartWithTheirShareOfTheSpeed) {
  const Film film = shipped("carts");
  const auto runs = film.segments()[0].segment.runs();
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(last_velocities(runs[0].log()), (std::vector<double>{-1, 1}));
  EXPECT_EQ(last_velocities(runs[1].log()), (std::vector<double>{-0.5, 0.5}));
  EXPECT_EQ(last_velocities(runs[2].log()), (std::vector<double>{0, 0}));
}

/// Each ball is thrown up by the one below, which is a thousand times as heavy.
TEST(ShippedScenes, TheStackThrowsItsTopBall) {
  const Film film = shipped("stack");
  std::vector<double> expected;
  double thrown = 1;
  for (int ball = 0; ball < 3; ++ball) {
    expected.push_back((999 * thrown - 2) / 1001);
    thrown = (999 + 2000 * thrown) / 1001;
  }
  expected.push_back(thrown);
  const std::vector<double> velocities = last_velocities(film.scene()->runs()[0].log());
  ASSERT_EQ(velocities.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(velocities[i], expected[i], 1e-12) << i;
  }
}

/// Each hit of a piston that comes in at 1/2 makes the atom faster by 1.
TEST(ShippedScenes, ThePistonHeatsItsGas) {
  const Film film = shipped("piston");
  const Log& log = film.scene()->runs()[0].log();
  double speed = 1;
  for (Integer k = 1; k <= log.last(); ++k) {
    const Collision hit = log.collision(k);
    if (hit.second == 2) speed += 1;
    EXPECT_EQ(std::abs(hit.first_after.velocity[0]), speed) << k;
  }
  EXPECT_EQ(speed, 4);
}

TEST(ShippedScenes, TheRackGoesOffSymmetrically) {
  const Film film = shipped("rack");
  const State state = film.scene()->runs()[0].log().state_at(3);
  EXPECT_GT(state.count, 10);
  for (const Motion& ball : state.bodies) {
    const auto is_image = [&](const Motion& other) {
      return std::hypot(ball.position[0] - other.position[0],
                        ball.position[1] + other.position[1]) < 1e-9;
    };
    EXPECT_EQ(std::ranges::count_if(state.bodies, is_image), 1);
  }
}

/// How unevenly bodies lie in cells of 4 by 4: variance over mean of their numbers, which is 1 if
/// they lie at random.
double unevenness(const State& state) {
  std::array<double, 12> numbers = {};
  for (const Motion& body : state.bodies) {
    const auto cell = [](double place) { return static_cast<std::size_t>(place / 4); };
    ++numbers.at(3 * cell(body.position[0]) + cell(body.position[1]));
  }
  const double mean = double(state.bodies.size()) / double(numbers.size());
  double squares = 0;
  for (const double number : numbers) squares += (number - mean) * (number - mean);
  return squares / double(numbers.size()) / mean;
}

TEST(ShippedScenes, TheGranularGasComesTogether) {
  const Film film = shipped("granular");
  const Log& log = film.scene()->runs()[0].log();
  EXPECT_LT(unevenness(log.state_at(0)), 0.1);
  EXPECT_GT(unevenness(log.state_at(59)), 3);
  System elastic = log.system();
  elastic.restitution = 1;
  EXPECT_LT(unevenness(make_log(elastic, 60)->state_at(59)), 1.5);
}

/// The lines of text of a picture, by what they belong to and their baseline in their part of it.
using Lines = std::map<std::tuple<double, std::uint32_t, long>, std::string>;

void add_lines(const std::vector<DrawItem>& items, const Point& origin, Lines& lines) {
  for (const DrawItem& item : items) {
    if (const auto* group = std::get_if<GroupItem>(&item)) {
      add_lines(group->list->items, {group->bounds.x, origin.y + group->bounds.y}, lines);
    } else if (const auto* plate = std::get_if<PlateItem>(&item)) {
      add_lines(plate->plate->items, {origin.x, origin.y + plate->origin.y}, lines);
    } else if (const auto* text = std::get_if<TextItem>(&item)) {
      const auto thing = static_cast<std::uint32_t>(text->id) / ids_from(1);
      lines[{origin.x, thing, std::lround(origin.y + text->origin.y)}] += text->text;
    }
  }
}

/// The same with # in place of each number.
std::string without_numbers(const std::string& line) {
  std::string words;
  bool is_number = false;
  for (const char c : line) {
    const bool was_number = is_number;
    is_number = (c >= '0' && c <= '9') || (was_number && (c == '.' || c == ','));
    if (!is_number) words += c;
    if (is_number && !was_number) words += '#';
  }
  return words;
}

/// What has to be read: words. A number among them may change meanwhile.
std::set<std::string> sentences_of(const DrawList& picture) {
  Lines lines;
  add_lines(picture.items, {}, lines);
  std::set<std::string> sentences;
  for (const auto& [place, line] : lines) {
    const std::string words = without_numbers(line);
    if (std::ranges::count_if(words, [](unsigned char c) { return std::isalpha(c) != 0; }) > 2) {
      sentences.insert(words);
    }
  }
  return sentences;
}

std::map<std::string, Storyboard> shipped_storyboards() {
  std::map<std::string, Storyboard> stories;
  for (const auto& [name, file] : shipped_scenes()) {
    ScriptBuilder builder;
    builder.read_file(file);
    builder.set("here", "view.fps", "20");
    const Script script = builder.build();
    if (const auto* story = std::get_if<Storyboard>(&script)) stories.emplace(name, *story);
  }
  return stories;
}

TEST(ShippedStoryboards, LeaveTimeToRead) {
  constexpr double kPerSecond = 15;
  std::size_t read = 0;
  for (const auto& [name, story] : shipped_storyboards()) {
    const Film film(story);
    const double rate = to_double(film.view().frame_rate);
    std::map<std::string, std::int64_t> since;
    for (std::int64_t k = 0; k <= film.frame_count(); ++k) {
      std::set<std::string> shown;
      if (k < film.frame_count()) shown = sentences_of(film.frame(k));
      for (auto seen = since.begin(); seen != since.end();) {
        if (shown.contains(seen->first)) {
          ++seen;
          continue;
        }
        const double seconds = double(k - seen->second) / rate;
        const auto characters = double(std::ranges::count_if(
            seen->first, [](unsigned char byte) { return (byte & 0xC0) != 0x80; }));
        EXPECT_GE(seconds, characters / kPerSecond)
            << name << ", until " << double(k) / rate << " s: " << seen->first;
        seen = since.erase(seen);
        ++read;
      }
      for (const std::string& sentence : shown) since.try_emplace(sentence, k);
    }
  }
  EXPECT_GT(read, 30U);
}

TEST(ShippedStoryboards, WaitASecondBeforeTheFirstHit) {
  const Film film(shipped_storyboards().at("why-pi"));
  const double rate = to_double(film.view().frame_rate);
  for (const auto& [segment, first_frame, fade_frames] : film.segments()) {
    if (segment.runs().empty()) continue;
    const std::int64_t quiet = fade_frames + std::lround(rate);
    ASSERT_LT(quiet, segment.frame_count());
    const Log& log = segment.runs().front().log();
    EXPECT_EQ(log.count_at(segment.schedule()->time_of(quiet - 1)),
              log.count_at(segment.schedule()->time_of(0)))
        << "from " << double(first_frame) / rate << " s on";
  }
}

}  // namespace
}  // namespace piblocks
