// An editor: a program scrolls smoothly, by some pixels a picture, and rests; a cursor blinks.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "screen/material.hpp"
#include "screen/sample_text.hpp"

namespace piblocks::benchmark {
namespace {

constexpr Colour kGround = 0xfdfdfd;
constexpr Colour kBar = 0xececec;
constexpr Colour kInk = 0x24292e;
constexpr PixelRect kText = {320, 40, 1580, 1010};
constexpr int kNumbers_px = 70;
constexpr int kLines = 400;
/// Pictures of a movement, and of the rest after it.
constexpr int kMoving = 45;
constexpr int kCycle = 80;
constexpr int kBlink = 15;  ///< pictures
/// How far each movement goes, in pixels.
constexpr std::array kDistances = {180, 610, -340};

class Editor : public Application {
 public:
  Editor() {
    for (int i = 0; i < kLines; ++i) lines_.push_back(text_.code_line());
  }

  void draw(Screen& screen, int number) override {
    const int step = number % kCycle;
    if (number == 0) draw_window(screen);
    if (step < kMoving) {
      const int before = offset_px_;
      offset_px_ = offset_at(number / kCycle, step + 1);
      if (number == 0 || before != offset_px_) draw_text(screen);
    } else if (step % kBlink == 0) {
      draw_cursor(screen, step / kBlink % 2 == 1 ? kInk : kGround);
    }
  }

 private:
  /// Slow at first and at the end.
  static int offset_at(int movement, int step) {
    int from = 0;
    for (int i = 0; i < movement; ++i) from += kDistances.at(std::size_t(i));
    const double share = (1 - std::cos(std::numbers::pi * step / kMoving)) / 2;
    return from + int(std::lround(share * kDistances.at(std::size_t(movement))));
  }

  void draw_window(Screen& screen) {
    screen.fill(kWholeScreen, kGround);
    screen.fill({0, 0, kScreenWidth_px, kText.y_px}, kBar);
    screen.write(20, 8, "File   Edit   View   Search   Build   Help", kInk);
    screen.fill({0, kText.y_px, 300, kText.height_px}, 0xf4f4f4);
    for (int i = 0; i < 36; ++i) {
      screen.write(24 + 20 * (i % 3), 50 + 26 * i, text_.word() + "_" + text_.word() + ".cpp",
                   kInk);
    }
    screen.fill({0, 1050, kScreenWidth_px, 30}, 0x2a6f97);
    screen.write(20, 1054, "line 118, column 24   UTF-8   C++", 0xffffff);
  }

  void draw_text(Screen& screen) {
    cairo_t& cairo = screen.cairo();
    cairo_save(&cairo);
    cairo_rectangle(&cairo, kText.x_px, kText.y_px, kText.width_px, kText.height_px);
    cairo_clip(&cairo);
    screen.fill(kText, kGround);
    const int first = offset_px_ / Screen::kLineHeight_px;
    const int count = kText.height_px / Screen::kLineHeight_px + 2;
    for (int i = first; i < first + count; ++i) {
      draw_line(screen, i, kText.y_px + i * Screen::kLineHeight_px - offset_px_);
    }
    cairo_restore(&cairo);
  }

  void draw_line(Screen& screen, int index, int y_px) {
    const std::string& line = lines_.at(std::size_t(index));
    const int x = kText.x_px + kNumbers_px;
    screen.write(kText.x_px, y_px, fmt::format("{:4}", index + 1), 0xa0a0a0);
    if (line.find("//") != std::string::npos) {
      screen.write(x, y_px, line, 0x6a8759);
      return;
    }
    const std::size_t keyword = line.find_first_not_of(' ');
    const std::size_t end = std::min(line.find_first_of(" .", keyword), line.size());
    screen.write(x, y_px, line.substr(0, end), 0x9c3a9c);
    screen.write(x + int(end) * Screen::kCellWidth_px, y_px, line.substr(end), kInk);
  }

  /// Behind the text of a line in the middle, wherever that stands.
  void draw_cursor(Screen& screen, Colour colour) const {
    const int line = offset_px_ / Screen::kLineHeight_px + 20;
    screen.fill({kText.x_px + 1200, kText.y_px + line * Screen::kLineHeight_px - offset_px_, 2,
                 Screen::kLineHeight_px},
                colour);
  }

  SampleText text_{5};
  std::vector<std::string> lines_;
  int offset_px_ = 0;
};

}  // namespace

std::unique_ptr<Application> start_editor() { return std::make_unique<Editor>(); }

}  // namespace piblocks::benchmark
