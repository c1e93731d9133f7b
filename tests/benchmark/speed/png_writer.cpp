// The article's frames as PNG files, written by libraries: what the program's are compared with.
// In: the way of writing, the number of frames, a folder. Out: 000000.png and so on.
#include <CLI/CLI.hpp>
#include <cairo.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>
#include <png.h>

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "draw/canvas.hpp"
#include "draw/composition.hpp"
#include "scene/schedule.hpp"

namespace piblocks::benchmark {
namespace {

struct Options {
  std::string writer;
  std::string folder;
  std::int64_t frames = 1;
  int jobs = 1;
};

using Write = std::function<void(const ImageView&, const std::string& path)>;
using FilePtr = std::unique_ptr<std::FILE, decltype(&std::fclose)>;

void write_with_cairo(const ImageView& image, const std::string& path) {
  // Cairo does not write to the pixels of a surface that is only a source.
  auto* const pixels = const_cast<unsigned char*>(image.data);
  cairo_surface_t* const surface =
      cairo_image_surface_create_for_data(pixels, CAIRO_FORMAT_RGB24, image.width_px,
                                          image.height_px, static_cast<int>(image.stride_bytes));
  const cairo_status_t status = cairo_surface_write_to_png(surface, path.c_str());
  cairo_surface_destroy(surface);
  if (status != CAIRO_STATUS_SUCCESS) throw DrawError(cairo_status_to_string(status));
}

/// Without a jump target of its own libpng ends the program where it fails.
void write_with_libpng(const ImageView& image, const std::string& path, int level,
                       std::optional<int> filter) {
  const FilePtr file(std::fopen(path.c_str(), "wb"), &std::fclose);
  if (!file) throw IoError(fmt::format("cannot open {}", path));
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file.get());
  png_set_compression_level(png, level);
  if (filter) png_set_filter(png, PNG_FILTER_TYPE_BASE, *filter);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width_px),
               static_cast<png_uint_32>(image.height_px), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_set_bgr(png);
  png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (int y = 0; y < image.height_px; ++y) png_write_row(png, image.row(y));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
}

/// @param filter  without one libpng tries all of them on every row.
Write libpng_at(int level, std::optional<int> filter = {}) {
  return [level, filter](const ImageView& image, const std::string& path) {
    write_with_libpng(image, path, level, filter);
  };
}

const std::map<std::string, Write>& writers() {
  static const std::map<std::string, Write> kWriters = {{"cairo", write_with_cairo},
                                                        {"libpng1-up", libpng_at(1, PNG_FILTER_UP)},
                                                        {"libpng1", libpng_at(1)},
                                                        {"libpng6", libpng_at(6)}};
  return kWriters;
}

/// The frames of one thread, drawn as the program draws them.
void write_frames(const Options& options, std::int64_t begin, std::int64_t end) {
  Scene scene;
  scene.view.theme = Theme::article;
  const auto log = make_pair_log(scene.system);
  const Schedule schedule = make_schedule(scene, *log);
  const Composition composition(scene, *log);
  const Write& write = writers().at(options.writer);
  Canvas canvas(scene.view.width_px, scene.view.height_px);
  for (std::int64_t frame = begin; frame < end; ++frame) {
    canvas.update(composition.frame({log->state_at(schedule.time_of(frame))}));
    write(canvas.view(), fmt::format("{}/{:06}.png", options.folder, frame));
  }
}

void run(const Options& options) {
  std::vector<std::jthread> threads;
  for (int job = 0; job < options.jobs; ++job) {
    threads.emplace_back(write_frames, std::cref(options), options.frames * job / options.jobs,
                         options.frames * (job + 1) / options.jobs);
  }
}

std::string versions() {
  return fmt::format("cairo {} / libpng {}", cairo_version_string(), PNG_LIBPNG_VER_STRING);
}

}  // namespace
}  // namespace piblocks::benchmark

int main(int argc, char** argv) {
  using namespace piblocks::benchmark;
  Options options;
  CLI::App app("Writes the article's frames as PNG files.");
  app.set_version_flag("--version", versions());
  app.add_option("writer", options.writer, "cairo, libpng1-up, libpng1 or libpng6")
      ->required()
      ->check(CLI::IsMember(writers()));
  app.add_option("folder", options.folder, "Where the files go")->required();
  app.add_option("--frames", options.frames, "How many")->check(CLI::PositiveNumber);
  app.add_option("--jobs", options.jobs, "Threads")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  run(options);
}
