// What is encoded: applications whose windows are recorded.
// In: nothing. Out: applications that draw one picture after the other, always the same.
#pragma once

#include <array>
#include <memory>

#include "screen/screen.hpp"

namespace piblocks::benchmark {

inline constexpr int kPictures = 240;
inline constexpr int kPicturesPerSecond = 30;

class Application {
 public:
  virtual ~Application() = default;
  /// Makes the picture of the last one. The first call draws everything.
  /// @param number  of the picture, from 0
  virtual void draw(Screen& screen, int number) = 0;
};

std::unique_ptr<Application> start_terminal();
std::unique_ptr<Application> start_plot();
std::unique_ptr<Application> start_slides();
std::unique_ptr<Application> start_editor();
std::unique_ptr<Application> start_drawing();

struct Material {
  const char* name;
  std::unique_ptr<Application> (*start)();
};

inline constexpr std::array kMaterials = {
    Material{"terminal", start_terminal}, Material{"plot", start_plot},
    Material{"slides", start_slides}, Material{"editor", start_editor},
    Material{"drawing", start_drawing}};

}  // namespace piblocks::benchmark
