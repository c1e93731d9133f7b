// A terminal: commands are typed, and what they print scrolls by whole lines.
#include <deque>

#include "screen/material.hpp"
#include "screen/sample_text.hpp"

namespace piblocks::benchmark {
namespace {

constexpr Colour kGround = 0x1e1e2e;
constexpr Colour kText = 0xd8d8d8;
constexpr Colour kPrompt = 0x7ec86e;
constexpr int kMargin_px = 6;
constexpr int kLines = kScreenHeight_px / Screen::kLineHeight_px;
constexpr const char* kPromptText = "anna@desk:~/work$ ";
/// A command is typed in so many pictures, and prints in the others.
constexpr int kTyping = 36;
constexpr int kCycle = 60;

class Terminal : public Application {
 public:
  void draw(Screen& screen, int number) override {
    if (number == 0) {
      for (int i = 0; i < kLines / 2; ++i) lines_.push_back(text_.log_line());
      screen.fill(kWholeScreen, kGround);
      begin_command();
      draw_all(screen);
    }
    const int step = number % kCycle;
    if (step < kTyping) {
      if (step % 2 == 1) type(screen);
    } else {
      print(1 + text_.pick(3));
      if (step == kCycle - 1) begin_command();
      draw_all(screen);
    }
  }

 private:
  void begin_command() {
    lines_.emplace_back(kPromptText);
    command_ = "make " + text_.word();
    drop_old();
  }

  /// Draws one character and the cursor behind it.
  void type(Screen& screen) {
    std::string& line = lines_.back();
    const std::size_t typed = line.size() - std::string(kPromptText).size();
    if (typed >= command_.size()) return;
    const int x = kMargin_px + int(line.size()) * Screen::kCellWidth_px;
    const int y = int(lines_.size() - 1) * Screen::kLineHeight_px;
    line += command_[typed];
    screen.fill({x, y, 2 * Screen::kCellWidth_px, Screen::kLineHeight_px}, kGround);
    screen.write(x, y, line.substr(line.size() - 1), kText);
    draw_cursor(screen);
  }

  void print(int count) {
    for (int i = 0; i < count; ++i) lines_.push_back(text_.log_line());
    drop_old();
  }
  void drop_old() {
    while (lines_.size() > std::size_t(kLines)) lines_.pop_front();
  }

  void draw_cursor(Screen& screen) {
    screen.fill({kMargin_px + int(lines_.back().size()) * Screen::kCellWidth_px,
                 int(lines_.size() - 1) * Screen::kLineHeight_px, Screen::kCellWidth_px,
                 Screen::kLineHeight_px},
                kText);
  }

  void draw_all(Screen& screen) {
    screen.fill(kWholeScreen, kGround);
    int y = 0;
    for (const std::string& line : lines_) {
      screen.write(kMargin_px, y, line, kText);
      if (line.starts_with(kPromptText)) screen.write(kMargin_px, y, kPromptText, kPrompt);
      y += Screen::kLineHeight_px;
    }
    if (lines_.back().starts_with(kPromptText)) draw_cursor(screen);
  }

  SampleText text_{1};
  std::deque<std::string> lines_;
  std::string command_;
};

}  // namespace

std::unique_ptr<Application> start_terminal() { return std::make_unique<Terminal>(); }

}  // namespace piblocks::benchmark
