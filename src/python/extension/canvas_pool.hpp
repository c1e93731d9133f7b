// Canvases that are painted again as soon as nobody looks at them.
// In: draw lists of one film. Out: pictures, each of which keeps its pixels as long as it lives.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "draw/canvas.hpp"

namespace piblocks::python {

/// Thread-safe. Painting costs what differs from what the canvas showed before, so the canvas that
/// came back last is taken first.
class CanvasPool : public std::enable_shared_from_this<CanvasPool> {
 public:
  CanvasPool(int width_px, int height_px, Background background)
      : width_px_(width_px), height_px_(height_px), background_(background) {}

  /// A picture: pixels that nobody paints over.
  class Picture {
   public:
    Picture(std::shared_ptr<CanvasPool> pool, std::unique_ptr<Canvas> canvas)
        : pool_(std::move(pool)), canvas_(std::move(canvas)) {}
    ~Picture() { pool_->give_back(std::move(canvas_)); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    ImageView view() const { return canvas_->view(); }

   private:
    std::shared_ptr<CanvasPool> pool_;
    std::unique_ptr<Canvas> canvas_;
  };

  /// @throws DrawError
  std::shared_ptr<const Picture> paint(DrawList list) {
    std::unique_ptr<Canvas> canvas = take();
    if (!canvas) canvas = std::make_unique<Canvas>(width_px_, height_px_, background_);
    canvas->update(std::move(list));
    return std::make_shared<const Picture>(shared_from_this(), std::move(canvas));
  }

 private:
  /// Two, because a loop still has the last picture when it asks for the next.
  static constexpr std::size_t kMostIdle = 2;

  std::unique_ptr<Canvas> take() {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) return nullptr;
    std::unique_ptr<Canvas> canvas = std::move(idle_.back());
    idle_.pop_back();
    return canvas;
  }
  void give_back(std::unique_ptr<Canvas> canvas) {
    const std::scoped_lock lock(mutex_);
    if (idle_.size() < kMostIdle) idle_.push_back(std::move(canvas));
  }

  int width_px_;
  int height_px_;
  Background background_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Canvas>> idle_;
};

}  // namespace piblocks::python
