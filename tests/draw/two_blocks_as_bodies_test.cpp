// Two blocks beside a wall by whatever names: what is drawn of them is the same.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "draw/mirrored.hpp"
#include "render/renderings.hpp"

namespace piblocks {
namespace {

std::vector<DrawItem> diagrams_of(const DrawList& list) {
  std::vector<DrawItem> items;
  for (const DrawItem& item : list.items) {
    if (id_of(item) >= ItemId::panels && id_of(item) < ItemId::card) items.push_back(item);
  }
  return items;
}

TEST(TwoBlocksAsBodies, ArePaintedAsTwoBlocks) {
  for (const char* theme : kThemeNames) {
    for (const char* panel : {"velocity", "ellipse", "position", "unfolded", "mirrors", "time",
                              "count", "conservation", "certainty"}) {
      SCOPED_TRACE(std::string(theme) + ", " + panel);
      const Scene scene = scene_with(2, {{"view.theme", theme},
                                         {"view.size", "1280x1080"},
                                         {"show.panels", panel},
                                         {"show.overlays", "digits,time,energy,momentum"}});
      const Scene bodies = as_bodies(scene);
      const Scene turned = mirrored(scene);
      for (const Instant& at : {Instant(Rational(0)), Instant::turn(), Instant::last()}) {
        const DrawList picture = still_picture(scene, at);
        EXPECT_TRUE(still_picture(bodies, at) == picture);
        // Momentum is turned round, too. Other themes than the article's place diagrams by what
        // the counter is above.
        if (std::string_view(panel) == "conservation") continue;
        if (scene.view.theme != Theme::article) continue;
        EXPECT_FALSE(diagrams_of(picture).empty());
        EXPECT_TRUE(diagrams_of(still_picture(turned, at)) == diagrams_of(picture));
      }
    }
  }
}

TEST(TwoBlocksAsBodies, LoseEnergyAsTwoBlocks) {
  for (const char* restitution : {"0.99", "0.5"}) {  // a run that ends, and one that does not
    SCOPED_TRACE(restitution);
    const Scene scene = scene_with(2, {{"view.theme", "article"},
                                       {"show.panels", "time"},
                                       {"show.overlays", "time,energy"},
                                       {"restitution", restitution}});
    for (const Instant& at : {Instant(Rational(0)), Instant::turn(), Instant::last()}) {
      const DrawList picture = still_picture(scene, at);
      EXPECT_TRUE(still_picture(as_bodies(scene), at) == picture);
      EXPECT_FALSE(diagrams_of(picture).empty());
      EXPECT_TRUE(diagrams_of(still_picture(mirrored(scene), at)) == diagrams_of(picture));
    }
  }
}

}  // namespace
}  // namespace piblocks
