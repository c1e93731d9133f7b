// Scenes and schedules from settings.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include <string>
#include <utility>
#include <vector>

#include "scene/schedule.hpp"

namespace piblocks {

/// A key of the scene file and its text.
using Setting = std::pair<const char*, std::string>;

inline Scene paced_scene(const std::vector<Setting>& settings, int digits = 3) {
  ScriptBuilder builder;
  for (const auto& [key, text] : settings) builder.set("test", key, text);
  builder.set("test", "digits", std::to_string(digits));
  return builder.build_scene();
}

inline Schedule schedule_of(const Scene& scene) {
  return make_schedule(scene, *make_pair_log(scene.system));
}

inline Schedule schedule_of(const std::vector<Setting>& settings, int digits = 3) {
  return schedule_of(paced_scene(settings, digits));
}

/// The last stretch of every schedule: the picture stands at the end.
inline constexpr std::size_t kStand = 1;

/// Stretches follow each other, and time does not jump between them.
inline void expect_no_gaps(const Schedule& schedule) {
  const auto stretches = schedule.stretches();
  ASSERT_FALSE(stretches.empty());
  EXPECT_EQ(stretches.front().video_s, 0);
  for (std::size_t i = 1; i < stretches.size(); ++i) {
    const Stretch& before = stretches[i - 1];
    const Rational length_s = stretches[i].video_s - before.video_s;
    EXPECT_GT(length_s, 0) << i;
    EXPECT_EQ(before.time + before.speed * length_s, stretches[i].time) << i;
  }
}

}  // namespace piblocks
