// Every combination of overlays and diagrams in frames of many shapes: texts keep apart from each
// other, from blocks and from the margins, and can be read. What has no room is refused by its key.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "draw/look.hpp"
#include "scene/schedule.hpp"
#include "support/property.hpp"

namespace piblocks {
namespace {

constexpr std::array kShapes{"1920x1080", "1280x720",  "3840x2160", "1440x1080",
                             "1080x1080", "1080x1920", "2560x1080", "640x360"};
constexpr std::array kOverlays{"digits",   "masses", "velocities", "energy",
                               "momentum", "time",   "ruler"};
constexpr std::array kPanels{"velocity", "position", "unfolded",     "time",     "count",
                             "ellipse",  "mirrors",  "conservation", "certainty"};
constexpr std::array kArrangedThemes{"lecture", "lecture-light", "article", "print"};
constexpr std::array kDigits{1, 3, 8};

/// A raised or lowered part of a formula, in parts of its line.
constexpr double kScriptScale = 0.65;
/// Places are whole pixels where that makes them sharp.
constexpr double kRounded_px = 0.5;
constexpr double kRounding_px = 1e-6;

struct Placed : Box {
  double baseline;
  ItemId id;
  double size_px;  ///< of type; 0 of a block
};

/// The texts and blocks of a picture, and what is wrong with them.
class Arrangement {
 public:
  Arrangement(const DrawList& list, const View& view, const Fonts& fonts)
      : list_(list), view_(view), sizes_(view), fonts_(fonts) {
    add(list.items);
  }

  std::string problem() const {
    for (std::size_t i = 0; i < texts_.size(); ++i) {
      const Placed& text = texts_[i];
      if (!is_inside(text)) return text.what + " is outside of the margins";
      if (!can_be_read(text)) return text.what + " is too small";
      for (std::size_t k = 0; k < i; ++k) {
        if (overlap(text, texts_[k])) return text.what + " meets " + texts_[k].what;
      }
      for (const Placed& block : blocks_) {
        // A mass may be on its block, and the loupe has a label of its own.
        const bool belongs = shows(text.id, ItemId::masses)
                                 ? !shows(block.id, ItemId::loupe)
                                 : shows(text.id, ItemId::loupe) && shows(block.id, ItemId::loupe);
        if (belongs && block.holds(text)) continue;
        if (overlap(text, block)) return text.what + " meets " + block.what;
      }
    }
    return {};
  }
  std::size_t text_count() const { return texts_.size(); }

 private:
  void add(const std::vector<DrawItem>& items) {
    for (const DrawItem& item : items) {
      if (const auto* text = std::get_if<TextItem>(&item)) add(*text);
      if (const auto* plate = std::get_if<PlateItem>(&item)) add(plate->plate->items);
      if (const auto* block = std::get_if<RectangleItem>(&item)) add(*block);
      if (const auto* group = std::get_if<GroupItem>(&item)) {
        blocks_.push_back({{group->bounds, "the loupe"}, 0, group->id, 0});
      }
    }
  }
  void add(const TextItem& text) {
    if (text.text.empty() || text.text == " ") return;
    const double em = text.size_px;
    const double width = fonts_.of(text.face).width_em(text.text) * em;
    // Beside letters, brackets and commas hang below the line.
    const bool hangs =
        text.face == Face::math || text.text.find_first_of("gjpqyQ,;()[]") != std::string::npos;
    texts_.push_back(
        {{{text.origin.x, text.origin.y - 0.74 * em, width, (hangs ? 0.94 : 0.76) * em},
          "'" + text.text + "'"},
         text.origin.y,
         text.id,
         em});
  }
  void add(const RectangleItem& item) {
    if (item.id != ItemId::red_block && item.id != ItemId::blue_block) return;
    const bool is_red = item.id == ItemId::red_block;
    blocks_.push_back({{item.bounds, is_red ? "the red block" : "the blue block"}, 0, item.id, 0});
  }

  bool is_inside(const Placed& text) const {
    const bool is_counter = shows(text.id, ItemId::label) || shows(text.id, ItemId::count) ||
                            shows(text.id, ItemId::lit_count);
    const double margin = view_.theme == Theme::article && is_counter
                              ? 0  // of the article's own picture
                              : sizes_.margin - kRounding_px;
    // What hangs below the line may reach into the margin.
    return text.x >= margin && text.right() <= list_.width_px - margin && text.y >= margin / 2 &&
           text.baseline <= list_.height_px - margin + kRounded_px;
  }

  /// Whether a text has the least size of type, or is a script beside a text that has it.
  bool can_be_read(const Placed& text) const {
    const double least = style::kLeastType * sizes_.short_side - kRounding_px;
    return text.size_px >= least || std::ranges::any_of(texts_, [&](const Placed& base) {
             return base.size_px >= least &&
                    std::abs(base.size_px * kScriptScale - text.size_px) < kRounding_px &&
                    text.x >= base.x && text.x < base.right() + 4 * base.size_px;
           });
  }

  const DrawList& list_;
  const View& view_;
  Sizes sizes_;
  const Fonts& fonts_;
  std::vector<Placed> texts_;
  std::vector<Placed> blocks_;
};

struct Case {
  std::string size;
  std::string theme;
  int digits = 3;
  std::string overlays;
  std::string panels;
  bool has_title = false;
  bool has_caption = false;
  bool is_slowed = false;

  std::string text() const {
    std::string text = size + " --theme " + theme + " --digits " + std::to_string(digits);
    if (!overlays.empty()) text += " --show " + overlays;
    if (!panels.empty()) text += " --panels " + panels;
    return text + (has_title ? " titled" : "") + (has_caption ? " with a caption" : "") +
           (is_slowed ? " --slow-motion auto" : "");
  }
};

Scene scene_of(const Case& one) {
  Settings settings{{"digits", std::to_string(one.digits)}};
  const auto set = [&](const char* key, const std::string& text) {
    if (!text.empty()) settings.emplace_back(key, text);
  };
  set("view.size", one.size);
  set("view.theme", one.theme);
  set("show.overlays", one.overlays);
  set("show.panels", one.panels);
  if (one.has_title) set("show.title", "Why do two blocks count π?");
  if (one.has_caption) set("show.caption", "Two blocks, a wall and no friction");
  if (one.is_slowed) set("time.slow-motion", "auto");
  return scene_with(settings);
}

/// A refusal names a key and what would help, in one line.
std::string problem_of_refusal(const std::string& what) {
  const bool is_line = what.find('\n') == std::string::npos;
  const bool has_key = what.starts_with("show") || what.starts_with("view.");
  const std::size_t remedy = what.find("; ");
  const bool has_remedy =
      remedy != std::string::npos && (what.find("leave", remedy) != std::string::npos ||
                                      what.find("make", remedy) != std::string::npos);
  return is_line && has_key && has_remedy ? "" : "refused by: " + what;
}

class Arrangements : public testing::Test {
 protected:
  void expect_sound(const Case& one) {
    const Scene scene = scene_of(one);
    ++tried_;
    try {
      const Pictures pictures(scene);
      ++drawn_;
      const Rational end = span_of(scene, *pictures.log).to;
      for (const Rational& time : {Rational(0), Rational(33, 10), Rational(7, 2), end}) {
        const DrawList list = pictures.at(time, one.is_slowed && time != 0 ? 1000 : 1);
        const Arrangement arrangement(list, scene.view, fonts_);
        EXPECT_EQ(arrangement.problem(), "") << one.text() << " --at " << time;
        texts_ += arrangement.text_count();
      }
    } catch (const UsageError& error) {
      EXPECT_EQ(problem_of_refusal(error.what()), "") << one.text();
    }
  }

  Case any_case(std::string overlays, std::string panels) {
    const auto any = [this](const auto& names) {
      return names.at(static_cast<std::size_t>(random_.integer(0, std::ssize(names) - 1)));
    };
    return {any(kShapes),
            any(kArrangedThemes),
            any(kDigits),
            std::move(overlays),
            std::move(panels),
            random_.integer(0, 1) == 1,
            random_.integer(0, 1) == 1,
            random_.integer(0, 2) == 1};
  }

  Random random_{1618};
  Fonts fonts_;
  int tried_ = 0;
  int drawn_ = 0;
  std::size_t texts_ = 0;
};

std::vector<std::string> all_overlays() {
  std::vector<std::string> sets;
  for (unsigned bits = 0; bits < 1U << kOverlays.size(); ++bits) {
    std::string& names = sets.emplace_back();
    for (std::size_t i = 0; i < kOverlays.size(); ++i) {
      if ((bits >> i & 1) == 0) continue;
      if (!names.empty()) names += ',';
      names += kOverlays.at(i);
    }
  }
  return sets;
}

/// None, each one, each pair, all.
std::vector<std::string> panel_sets() {
  const std::vector<std::string> names(kPanels.begin(), kPanels.end());
  std::vector<std::string> sets{""};
  std::string all;
  for (const std::string& name : names) {
    sets.push_back(name);
    all += (all.empty() ? "" : ",") + name;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) sets.push_back(names[k] + "," + names[i]);
  }
  sets.push_back(all);
  return sets;
}

TEST_F(Arrangements, OfEveryCombinationOfOverlays) {
  for (const std::string& overlays : all_overlays()) {
    for (const char* shape : kShapes) {
      Case one = any_case(overlays, "");
      one.size = shape;
      expect_sound(one);
    }
  }
  EXPECT_GT(drawn_, tried_ * 3 / 4);
  EXPECT_GT(texts_, 1000U);
}

TEST_F(Arrangements, OfEveryCombinationOfDiagrams) {
  for (const std::string& panels : panel_sets()) {
    for (const char* shape : kShapes) {
      Case one = any_case("", panels);
      one.size = shape;
      expect_sound(one);
      one = any_case("masses,velocities", panels);
      one.size = shape;
      expect_sound(one);
    }
  }
  EXPECT_GT(drawn_, tried_ / 2);
}

TEST_F(Arrangements, OfOverlaysAndDiagramsTogether) {
  const std::vector<std::string> panels = panel_sets();
  for (const std::string& overlays : all_overlays()) {
    for (std::int64_t i = 0; i < many(6); ++i) {
      const auto any = static_cast<std::size_t>(random_.integer(0, std::ssize(panels) - 1));
      expect_sound(any_case(overlays, panels.at(any)));
    }
  }
  EXPECT_GT(drawn_, tried_ / 3);
}

}  // namespace
}  // namespace piblocks
