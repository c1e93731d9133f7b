#include "cli/tolerance_options.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include "core/text.hpp"
#include "golden/mask_picture.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks::cli {
namespace {

Rational parse_delta(const std::string& text) {
  Rational delta = parse_rational(text);
  if (delta < 0 || delta > 255) throw UsageError("must be a number from 0 to 255");
  return delta;
}

std::int64_t parse_pixels(const std::string& text) {
  return parse_whole_number(text, 0, to_integer(kMaxFrame_px)).get_si();
}

/// "0.1%", of the pixels of a frame.
Rational parse_share(const std::string& text) {
  Rational share = parse_rational(text.substr(0, text.size() - 1)) / 100;
  if (share < 0 || share > 1) throw UsageError("must be a number of pixels, or from 0% to 100%");
  return share;
}

double parse_threshold(const std::string& text) {
  const Rational threshold = parse_rational(text);
  if (threshold < 0 || threshold > 1) throw UsageError("must be a number from 0 to 1");
  return to_double(threshold);
}

/// "16:40", at most 40 pixels in any square of 16x16.
Window parse_window(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw UsageError("must be N:K, such as 16:40");
  return {parse_int(text.substr(0, colon), 1, kMaxSide_px), parse_pixels(text.substr(colon + 1))};
}

/// "640x80+100+20", from the left and the top.
PixelRect parse_rect(const std::string& text) {
  const std::size_t x = text.find('x');
  const std::size_t left = text.find('+');
  const std::size_t top = text.find('+', left + 1);
  if (x == std::string::npos || left == std::string::npos || top == std::string::npos || x > left) {
    throw UsageError(
        "must be WxH+X+Y, such as 640x80+100+20, or a PNG file, or one of these behind NAME:");
  }
  const auto number = [&](std::size_t begin, std::size_t end, int low) {
    return parse_int(text.substr(begin, end - begin), low, kMaxSide_px);
  };
  return {number(left + 1, top, 0), number(top + 1, std::string::npos, 0), number(0, x, 1),
          number(x + 1, left, 1)};
}

/// A rectangle or a picture, perhaps behind the name of the pictures that it is for.
Mask parse_mask(const std::string& text) {
  Mask mask{.text = text};
  const std::size_t colon = text.rfind(':');
  const bool is_named = colon != std::string::npos;
  if (is_named) mask.name_pattern = text.substr(0, colon);
  const std::string place = is_named ? text.substr(colon + 1) : text;
  if (is_named && mask.name_pattern.empty())
    throw UsageError("there is no name in front of the colon");
  if (!has_ending(place, ".png")) {
    mask.rects = {parse_rect(place)};
    return mask;
  }
  Image picture;
  try {
    picture = read_png(place);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  Mask drawn = mask_of_picture(text, picture);
  drawn.name_pattern = mask.name_pattern;
  return drawn;
}

Tolerance tolerance_of(const OptionTexts& options) {
  Tolerance tolerance;
  tolerance.max_delta = options.value("--max-delta", parse_delta).value_or(0);
  tolerance.hard_delta = options.value("--hard-delta", parse_delta).value_or(255);
  tolerance.window = options.value("--max-window", parse_window);
  // A bound on any window replaces the default bound on the whole frame.
  tolerance.max_pixels = tolerance.window ? kMaxFrame_px : 0;
  if (const auto most = options.text("--max-pixels"); most && most->ends_with('%')) {
    tolerance.max_share = *options.value("--max-pixels", parse_share);
    tolerance.max_pixels = kMaxFrame_px;
  } else if (most) {
    tolerance.max_pixels = *options.value("--max-pixels", parse_pixels);
  }
  tolerance.threshold = options.value("--threshold", parse_threshold);
  tolerance.counts_antialiasing = options.is_given("--count-antialiasing");
  tolerance.ignores_transparent = options.is_given("--ignore-transparent");
  if (tolerance.threshold && options.is_given("--max-delta")) {
    throw UsageError("--threshold and --max-delta: use one of them");
  }
  if (tolerance.counts_antialiasing && !tolerance.threshold) {
    throw UsageError("--count-antialiasing belongs to --threshold, which is not given");
  }
  return tolerance;
}

}  // namespace

Mask mask_of_picture(const std::string& text, const Image& picture) {
  Mask mask{.text = text,
            .rects = rects_of_mask(picture),
            .whole = PixelRect{0, 0, picture.width_px, picture.height_px}};
  if (mask.rects.empty()) throw UsageError("all of it is black or transparent: it hides nothing");
  return mask;
}

void read_tolerance(const OptionTexts& options, ComparisonJob& job) {
  job.tolerance = tolerance_of(options);
  for (const std::string& mask : options.texts("--mask")) {
    try {
      job.masks.push_back(parse_mask(mask));
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("--mask {}: {}", mask, error.what()));
    }
  }
}

}  // namespace piblocks::cli
