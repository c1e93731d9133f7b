#include <fmt/format.h>

#include <algorithm>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

std::string text_of(const Rational& slower) {
  if (slower == 1) return {};
  if (slower < 1) return fmt::format("{}× faster", short_text(1 / slower));
  return fmt::format("{}× slower", short_text(slower));
}

}  // namespace

bool has_slow_motion(const Pacing& pacing) {
  return pacing.automatic_slow_motion || !pacing.slow_motion.empty();
}

ReadOut slower_read_out(const Setting& setting) {
  const Pacing& pacing = setting.scene.pacing;
  ReadOut read_out{"slow motion",
                   {},
                   [](const FrameState& shown) { return text_of(shown.slower); },
                   setting.palette.accent};
  const auto make_room = [&](const Rational& slower) {
    std::string text = text_of(slower);
    if (setting.font.width_em(text) > setting.font.width_em(read_out.widest)) {
      read_out.widest = std::move(text);
    }
  };
  for (const SlowMotion& slow : pacing.slow_motion) make_room(slow.factor);
  if (pacing.automatic_slow_motion) make_room(kMaxAutomaticFactor);
  return read_out;
}

}  // namespace piblocks
