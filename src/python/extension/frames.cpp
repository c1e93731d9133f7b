#include <piblocks/encode.hpp>
#include <piblocks/instant.hpp>
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "draw/canvas.hpp"
#include "media/pixels/rgb24.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"
#include "render/renderings.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

/// Canvases that are painted again as soon as nobody looks at them. Thread-safe. Painting costs
/// what differs from what the canvas showed before, so the canvas that came back last is taken
/// first.
class CanvasPool : public std::enable_shared_from_this<CanvasPool> {
 public:
  CanvasPool(int width_px, int height_px, Background background)
      : width_px_(width_px), height_px_(height_px), background_(background) {}

  /// The pixels of a picture, which nobody paints over, for Python's buffer protocol. It may
  /// outlive everything else.
  class Frame {
   public:
    Frame(std::shared_ptr<CanvasPool> pool, std::unique_ptr<Canvas> canvas)
        : pool_(std::move(pool)), canvas_(std::move(canvas)) {}
    ~Frame() { pool_->give_back(std::move(canvas_)); }
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    ImageView view() const { return canvas_->view(); }

   private:
    std::shared_ptr<CanvasPool> pool_;
    std::unique_ptr<Canvas> canvas_;
  };

  /// @throws DrawError
  std::shared_ptr<Frame> paint(DrawList list) {
    std::unique_ptr<Canvas> canvas = take();
    if (!canvas) canvas = std::make_unique<Canvas>(width_px_, height_px_, background_);
    canvas->update(std::move(list));
    return std::make_shared<Frame>(shared_from_this(), std::move(canvas));
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

using Frame = CanvasPool::Frame;

/// Every frame and every instant of a script. What they need is made when the first is asked for.
class Pictures {
 public:
  explicit Pictures(std::shared_ptr<const BoundScript> script) : script_(std::move(script)) {
    const View& view = view_of(script_->script);
    pool_ = std::make_shared<CanvasPool>(view.width_px, view.height_px, view.background);
  }

  std::int64_t frame_count() {
    const WithoutGil released;
    return film().frame_count();
  }
  std::shared_ptr<Frame> frame(std::int64_t number) {
    const WithoutGil released;
    const Film& all = film();
    if (number < 0 || number >= all.frame_count()) throw std::out_of_range("no such frame");
    return pool_->paint(all.frame(number));
  }
  /// The picture of 'piblocks still'.
  std::shared_ptr<Frame> still(const std::string& at) {
    const WithoutGil released;
    return pool_->paint(list_at(instant_of("t", at)));
  }
  /// Simulation time of a frame of a single scene.
  double time_of(std::int64_t number) {
    const WithoutGil released;
    scene_of(*script_, "time");
    return to_double(film().segments().front().segment.schedule()->time_of(number));
  }

 private:
  DrawList list_at(const Instant& instant) {
    return std::holds_alternative<Scene>(script_->script) ? run().still(instant)
                                                          : still_picture(film(), instant);
  }
  const Film& film() {
    const std::scoped_lock lock(mutex_);
    if (!film_) film_ = std::make_unique<const Film>(script_->script);
    return *film_;
  }
  const FilmRun& run() {
    const std::scoped_lock lock(mutex_);
    if (!run_) run_ = std::make_unique<const FilmRun>(run_of(std::get<Scene>(script_->script)));
    return *run_;
  }

  std::shared_ptr<const BoundScript> script_;
  std::shared_ptr<CanvasPool> pool_;
  std::mutex mutex_;  // of the two below; both are thread-safe once they are made
  std::unique_ptr<const Film> film_;
  std::unique_ptr<const FilmRun> run_;
};

/// Bytes B, G, R and, if the picture has it, alpha, which the others have been multiplied by.
py::buffer_info buffer_of(const Frame& frame) {
  const ImageView view = frame.view();
  return {const_cast<std::uint8_t*>(view.data),
          1,
          py::format_descriptor<std::uint8_t>::format(),
          3,
          {py::ssize_t(view.height_px), py::ssize_t(view.width_px), py::ssize_t(4)},
          {py::ssize_t(view.stride_bytes), py::ssize_t(4), py::ssize_t(1)},
          /*readonly=*/true};
}

/// Fills rows of R, G, B and straight alpha, as a PNG file has them.
void copy_rgba(const Frame& frame, const py::buffer& buffer) {
  const ImageView view = frame.view();
  const std::size_t row_bytes = std::size_t(view.width_px) * 4;
  std::uint8_t* const to = bytes_of(buffer, row_bytes * std::size_t(view.height_px)).data();
  const WithoutGil released;
  const PixelRect all{0, 0, view.width_px, view.height_px};
  for (int y = 0; y < view.height_px; ++y) {
    pack_row_rgba(view, all, y, to + std::size_t(y) * row_bytes);
  }
}

py::bytes png_of_frame(const Frame& frame) {
  return bytes_object(without_gil([&] { return encode_png(frame.view()); }));
}

}  // namespace

void bind_frames(py::module_& module) {
  py::class_<Frame, std::shared_ptr<Frame>>(
      module, "Frame", py::buffer_protocol(),
      "Pixels of one picture, as a read-only buffer of height x width x 4 bytes: "
      "blue, green, red, and alpha, which the colours are multiplied by.")
      .def_property_readonly("has_alpha", [](const Frame& frame) { return frame.view().has_alpha; })
      .def("copy_rgba", &copy_rgba, py::arg("buffer"), "Fills rows of R, G, B, straight alpha.")
      .def("png", &png_of_frame, "The picture as a PNG file.")
      .def_buffer(&buffer_of);
  py::class_<Pictures, std::shared_ptr<Pictures>>(module, "Pictures",
                                                  "Every frame and every instant of a script.")
      .def(py::init<std::shared_ptr<BoundScript>>(), py::arg("script"))
      .def_property_readonly("frame_count", &Pictures::frame_count)
      .def("frame", &Pictures::frame, py::arg("number"), "A frame of the film, from 0.")
      .def("still", &Pictures::still, py::arg("at"), "The picture at an instant.")
      .def("time", &Pictures::time_of, py::arg("number"), "Simulation time that a frame shows.");
}

}  // namespace piblocks::python
