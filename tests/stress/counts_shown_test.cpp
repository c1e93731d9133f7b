// The count that is on the picture, at every kind of anchor, in every kind of output.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <string>
#include <tuple>
#include <vector>

#include "draw/found_items.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"
#include "render/video_text.hpp"
#include "scene/schedule.hpp"
#include "support/contains.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::contains;

/// What the counter of a picture says, without its separators.
std::string shown_count(const DrawList& list) {
  std::string count = item_of<TextItem>(list, ItemId::count).text;
  std::erase(count, ',');
  return count;
}

Scene scene_of_blocks(const TwoBlocks& system) {
  Scene scene;
  scene.system = system_of(system);
  scene.view.theme = Theme::article;
  scene.view.width_px = 64;
  scene.view.height_px = 36;
  scene.view.frame_rate = 2;
  return scene;
}

TwoBlocks system_of_ratio(const Rational& ratio) {
  TwoBlocks system;
  system.red.mass = ratio;
  return system;
}

/// For its texts alone.
Film unpainted(const Script& script) { return Film(script, {FilmUse::audio_only}); }

/// An instant named by its anchor, and the count that is true of it.
struct Anchored {
  Instant instant;
  Integer count;
};

std::vector<Anchored> anchors_of(const PairLog& log) {
  const Integer& total = log.last();
  const Rational turn = *turn_of(log.blocks());
  return {{Instant::last(), total},
          {Instant::collision(total), total},
          {Instant::collision(1), 1},
          {Instant::collision((total + 1) / 2), (total + 1) / 2},
          {Instant::turn(), log.blocks_at(turn).count}};
}

std::string last_count(const Scene& scene) {
  const Film film(scene);
  return shown_count(film.frame(film.frame_count() - 1));
}

/// A scene from time 0 to an instant, in four seconds.
Scene until(const Instant& instant, Scene scene) {
  scene.time.from = Rational(0);
  scene.time.to = instant;
  scene.pacing.duration_s = 4;
  return scene;
}

/// Films that end at the anchor, stand still at it, begin with it or play back from it.
void expect_in_films(const Scene& scene, const Anchored& at) {
  const std::string count = at.count.get_str();
  Scene film = until(at.instant, scene);
  EXPECT_EQ(last_count(film), count) << "end, fitted to a duration";
  film.pacing.hold_end_s = 1;
  EXPECT_EQ(last_count(film), count) << "held end";

  Scene frozen = scene;
  frozen.time.to = Instant::last(3);
  frozen.time.speed = 20;
  frozen.pacing.freezes = {{at.instant, 2}};
  const Schedule schedule = make_schedule(frozen, *make_pair_log(frozen.system));
  const auto stop = std::ranges::find(schedule.stretches(), 0, &Stretch::speed);
  const Film stands(frozen);
  const std::int64_t frame = ceil(stop->video_s * 2).get_si();
  EXPECT_EQ(shown_count(stands.frame(frame)), count) << "freeze";
  EXPECT_EQ(shown_count(stands.frame(frame + 1)), count) << "freeze";

  Scene later = scene;
  later.time.from = at.instant;
  later.time.to = Instant::last(40);
  later.time.speed = 20;
  EXPECT_EQ(shown_count(Film(later).frame(0)), count) << "begin";

  Scene looped = until(at.instant, scene);
  looped.pacing.duration_s = 5;
  looped.pacing.loop = true;
  const Film loop(looped);
  EXPECT_EQ(shown_count(loop.frame(loop.frame_count() / 2)), count) << "turn of a loop";
}

void expect_in_texts(const Scene& scene, const Anchored& at) {
  const Film film = unpainted(until(at.instant, scene));
  std::string alt = describe_film(film);
  std::erase(alt, ',');
  EXPECT_TRUE(contains(alt, "a counter reaches " + at.count.get_str() + " ")) << alt;
  std::string text = captions(film);
  std::erase(text, ',');
  EXPECT_TRUE(contains(text, "\n" + at.count.get_str() + " collision")) << "captions";
}

void expect_everywhere(const TwoBlocks& system) {
  const Scene scene = scene_of_blocks(system);
  const auto log = make_pair_log(system);
  SCOPED_TRACE("ratio " + system.red.mass.get_str());
  for (const Anchored& at : anchors_of(*log)) {
    SCOPED_TRACE(exact_text(at.instant));
    const std::string count = at.count.get_str();
    EXPECT_EQ(shown_count(still_picture(scene, at.instant)), count);
    EXPECT_EQ(shown_count(sheet_pictures(run_of(scene), {at.instant}).front().picture), count)
        << "sheet";
    expect_in_films(scene, at);
    expect_in_texts(scene, at);
  }
}

TEST(CountsShown, AreRightForAnyMassRatio) {
  TracedRandom random(2718);
  for (int i = 0; i < 200; ++i) {
    expect_everywhere(system_of_ratio(random.rational(1, 2'000'000, 1000) / 4 + 1));
    if (HasFailure()) return;
  }
}

TEST(CountsShown, AreRightForAnyNumberOfDigits) {
  for (int digits = 1; digits <= 40; ++digits) {
    expect_everywhere(article_blocks(digits));
    if (HasFailure()) return;
  }
}

/// Pictures, also of sheets; pages and captions of videos are decimal.
TEST(CountsShown, AreInTheBaseOfTheScene) {
  for (const auto& [base, digits] : {std::pair{2, 9}, {3, 6}, {16, 3}, {36, 3}}) {
    Scene scene = scene_of_blocks(article_blocks(digits, base));
    scene.show.base = base;
    const auto log = make_pair_log(scene.system);
    for (const Anchored& at : anchors_of(*log)) {
      const std::string count = at.count.get_str(base);
      EXPECT_EQ(shown_count(still_picture(scene, at.instant)), count);
      EXPECT_EQ(shown_count(sheet_pictures(run_of(scene), {at.instant}).front().picture), count)
          << "sheet";
      expect_in_texts(scene, at);
    }
  }
}

TEST(CountsShown, AreRightInTimesBeforeZero) {
  TwoBlocks system;
  system.red.velocity = 1;
  const Scene scene = scene_of_blocks(system);
  EXPECT_EQ(shown_count(still_picture(scene, Instant(Rational(-20)))), "-314");
  EXPECT_EQ(shown_count(still_picture(scene, Instant::collision(-7))), "-7");
  EXPECT_EQ(shown_count(still_picture(scene, Instant::collision(0))), "0");
  Scene film = scene;
  film.time.from = Rational(-20);
  film.time.to = Rational(1);
  const std::string text = captions(unpainted(film));
  EXPECT_TRUE(contains(text, "100 collisions or more to go until time 0"));
  // Count 0 is reached before time 0, and kept after it.
  EXPECT_TRUE(text.ends_with("\nNo collision between now and time 0\n")) << text;
}

TEST(CountsShown, AreRightInWords) {
  const auto sentence = [](const TwoBlocks& system, const Instant& to, int base = 10) {
    Scene scene = scene_of_blocks(system);
    scene.show.base = base;
    scene.time.from = Rational(to.is_time() && to.offset < 0 ? -20 : 0);
    if (to.anchor == Instant::Anchor::collision) scene.time.from = Rational(-20);
    scene.time.to = to;
    const std::string text = describe_film(unpainted(scene));
    return text.substr(text.find("a counter"));
  };
  const TwoBlocks article = article_blocks(3);
  TwoBlocks parting = article;
  parting.red.velocity = 1;
  TwoBlocks bounced = parting;  // blue follows red from the wall, and never reaches it
  bounced.blue.velocity = Rational(-1, 2);
  EXPECT_EQ(
      sentence(article, Instant::last()),
      "a counter reaches 314 collisions, after which there are no more. The count has the first "
      "3 digits of π, 3.14.");
  EXPECT_EQ(sentence(bounced, Instant::last()),
            "a counter reaches 1 collision, after which there are no more.");
  EXPECT_EQ(sentence(article, Instant::collision(7)), "a counter reaches 7 of 314 collisions.");
  EXPECT_EQ(sentence(article, Rational(1)), "a counter reaches 0 of 314 collisions.");
  EXPECT_EQ(sentence(parting, Rational(1)),
            "a counter reaches 0: there are no collisions from time 0 on.");
  parting.red.mass = 100'000'000;
  EXPECT_EQ(sentence(parting, Rational(-19)),
            "a counter reaches -31,415: 31,415 collisions are to go until time 0.");
  EXPECT_EQ(sentence(article, Instant::last(), 16),
            "a counter reaches 314 collisions, after which there are no more. It is written in "
            "base 16: 13a.");
  EXPECT_EQ(sentence(parting, Instant::collision(-1)),
            "a counter reaches -1: 1 collision is to go until time 0.");
}

/// The digits of pi, where the count is made of them.
TEST(CountsShown, OfPiAreSaidInTexts) {
  const auto film = [](const TwoBlocks& system, int base, int hold_end_s = 9) {
    Scene scene = scene_of_blocks(system);
    scene.show.base = base;
    scene.time.to = Instant::last();
    scene.pacing.hold_end_s = hold_end_s;
    return unpainted(scene);
  };
  for (const auto& [base, digits, words, pi] :
       {std::tuple{10, 1, "the first digit of π", "3"},
        {10, 5, "the first 5 digits of π", "3.1415"},
        {2, 5, "the first 6 digits of π in base 2", "11.0010"},
        {16, 3, "the first 3 digits of π in base 16", "3.24"}}) {
    const Film held = film(article_blocks(digits, base), base);
    const std::string said = captions(held);
    EXPECT_TRUE(said.ends_with(fmt::format(": {}, {}\n", words, pi))) << said;
    const std::string alt = describe_film(held);
    EXPECT_TRUE(alt.ends_with(fmt::format(" The count has {}, {}.", words, pi))) << alt;
  }
  EXPECT_TRUE(captions(film(article_blocks(100), 10, 12)).ends_with("the first 100 digits of π\n"));
  TwoBlocks thrown = article_blocks(3);
  thrown.blue.velocity = Rational(-1, 3);
  TwoBlocks lossy = article_blocks(3);
  lossy.blocks_restitution = Rational(9999, 10000);
  for (const auto& [system, base] :
       {std::pair{system_of_ratio(50), 10}, {article_blocks(3), 2}, {thrown, 10}, {lossy, 10}}) {
    const Film none = film(system, base);
    EXPECT_FALSE(contains(captions(none) + describe_film(none), "π"));
  }
  Scene cut = scene_of_blocks(article_blocks(3));
  cut.time.to = Rational(7, 2);
  EXPECT_FALSE(contains(captions(unpainted(cut)), "π"));
}

/// 20 characters a second: 76 of them take 3.8 s, 25 take 1.25 s.
TEST(CountsShown, TheLastComesWithWhatThereIsTimeToRead) {
  const auto last_caption = [](const Rational& hold_end_s) {
    Scene scene = scene_of_blocks(article_blocks(3));
    scene.view.frame_rate = 20;
    scene.time.to = Instant::last();
    scene.pacing.hold_end_s = hold_end_s;
    const std::string text = captions(unpainted(scene));
    const std::size_t end = text.size() - 1;
    return text.substr(text.rfind('\n', end - 1) + 1, end - text.rfind('\n', end - 1) - 1);
  };
  const std::string all =
      "314 collisions, after which there are no more: the first 3 digits of π, 3.14";
  EXPECT_EQ(last_caption(Rational(19, 5)), all);
  EXPECT_EQ(last_caption(Rational(18, 5)), "314 collisions: π = 3.14…");
  EXPECT_EQ(last_caption(Rational(13, 10)), "314 collisions: π = 3.14…");
  EXPECT_EQ(last_caption(Rational(11, 10)), "314 collisions");
}

/// "100 or more" would mislead beside a picture that says 313 for seconds.
TEST(CountsShown, ThatStandAreSaidAsTheyAre) {
  TracedRandom random(313);
  int stood = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene = scene_of_blocks(system_of_ratio(random.rational(1, 20'000, 10) + 1));
    scene.view.frame_rate = Rational(random.integer(2, 9));
    scene.pacing.loop = random.integer(0, 1) == 0;
    scene.pacing.hold_end_s = random.integer(0, 1);
    if (random.integer(0, 1) == 0) scene.pacing.freezes = {{Instant::collision(2), 2}};
    const auto run = log_of(scene);
    const Schedule schedule = make_schedule(scene, *run);
    std::string text = captions(unpainted(scene));
    std::erase(text, ',');
    std::map<std::int64_t, std::string> cues;  // by their first frame
    const std::regex cue("00:([0-9]+):([0-9.]+) --> [^\n]*\n([^\n]*)");
    for (std::sregex_iterator found(text.begin(), text.end(), cue), end; found != end; ++found) {
      const double begin_s = 60 * std::stod((*found)[1]) + std::stod((*found)[2]);
      cues[std::llround(std::floor(begin_s * to_double(scene.view.frame_rate)))] = (*found)[3];
    }
    const std::int64_t frames = film_frames(schedule);
    std::int64_t since = 0;
    for (std::int64_t k = 0; k < frames; ++k) {
      const Integer count = run->count_at(schedule.time_of(k));
      if (k > 0 && count != run->count_at(schedule.time_of(k - 1))) since = k;
      if (count == 0 || k - since + 1 < scene.view.frame_rate) continue;
      ++stood;
      const std::string& said = std::prev(cues.upper_bound(k))->second;
      ASSERT_TRUE(said.starts_with(count.get_str() + " collision") && !contains(said, "more to") &&
                  !contains(said, "or more"))
          << said << " at frame " << k << " of " << frames << ": " << count;
    }
  }
  EXPECT_GT(stood, 100);
}

/// Blocks that lose so much that they never part.
TEST(CountsShown, InfinitelyManyAreSaidToBe) {
  TwoBlocks system = article_blocks(2);
  system.blocks_restitution = system.wall_restitution = Rational(1, 2);
  for (const Theme theme : {Theme::article, Theme::lecture}) {
    Scene scene = scene_of_blocks(system);
    scene.view.theme = theme;
    scene.view.width_px = 640;
    scene.view.height_px = 360;
    const auto log = make_pair_log(system);
    EXPECT_EQ(shown_count(still_picture(scene, Instant::last())), "∞");
    EXPECT_EQ(shown_count(still_picture(scene, Instant(Rational(9)))), "∞");
    EXPECT_EQ(shown_count(still_picture(scene, Instant::collision(7))), "7");
    const Integer before = log->last() - 1;
    EXPECT_EQ(shown_count(still_picture(scene, Instant::collision(before))), before.get_str());
    scene.time.to = Rational(9);
    const Film film = unpainted(scene);
    const std::string text = describe_film(film);
    EXPECT_FALSE(contains(text, "elastic"));
    EXPECT_TRUE(contains(text, "The coefficient of restitution is 0.5 between the blocks"));
    EXPECT_TRUE(contains(text, "reaches infinitely many collisions, after which both"));
    EXPECT_TRUE(contains(title_of(film), "infinitely many"));
    const std::string said = captions(film);
    EXPECT_TRUE(said.ends_with("\nInfinitely many collisions\n")) << said;
    scene.show.base = 2;
    EXPECT_FALSE(contains(describe_film(unpainted(scene)), "base"));
  }
}

TEST(CountsShown, AreRightInTheSecondsOfAStoryboard) {
  Storyboard story;
  story.view = scene_of_blocks(article_blocks(3)).view;
  Scene run = scene_of_blocks(article_blocks(3));
  run.time.to = Instant::last();
  run.pacing.duration_s = 4;
  run.pacing.hold_end_s = 1;
  story.segments.push_back({Card{{"314"}, 1}});
  story.segments.push_back({.content = Scenes{run}, .fade_s = Rational(1, 2)});
  EXPECT_EQ(shown_count(still_picture(story, Instant::last())), "314");
  EXPECT_EQ(shown_count(still_picture(story, Instant::last(Rational(-1, 2)))), "314");
}

}  // namespace
}  // namespace piblocks
