#include "media/output/output.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "core/overwrite_check.hpp"
#include "core/text.hpp"
#include "media/libav/av_module.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace {

/// A function of the module that has libav.
template <auto AvModule::*SetUpInModule>
Output by_module(const OutputRequest& request) {
  return (av_module().*SetUpInModule)(request);
}

// What a kind of output takes or does; flags.
constexpr unsigned kSettings = 1;  // of an encoder
constexpr unsigned kAlpha = 2;
constexpr unsigned kSound = 4;
constexpr unsigned kPictures = 8;  // keeps them
constexpr unsigned kPlays = 16;    // says how often it plays
constexpr unsigned kNumbers = 32;  // has numbered files
constexpr unsigned kCaptions = 64;
constexpr unsigned kVector = 128;
constexpr unsigned kWhole = 256;  // cannot be joined of parts

struct OutputKind {
  std::string_view ending;  ///< of its files' names, or the whole name if that has no dot
  Output (*set_up)(const OutputRequest& request);
  unsigned flags;
  std::string_view note = {};  ///< behind its name in messages
  int max_frame_rate = 0;      ///< 0 if there is no limit

  bool is_file() const { return ending.starts_with('.'); }
  bool has(unsigned wanted) const { return (flags & wanted) == wanted; }
};

constexpr std::array kOutputKinds = {
    OutputKind{".mp4", mp4_output, kPictures | kSettings | kSound | kCaptions},
    OutputKind{".mov", by_module<&AvModule::mov_output>, kPictures | kSettings | kSound | kAlpha},
    OutputKind{".webm", by_module<&AvModule::webm_output>, kPictures | kSettings | kSound | kAlpha},
    OutputKind{".gif", gif_output, kPictures | kPlays, "", kMaxFrameRate_gif},
    OutputKind{".apng", apng_output, kPictures | kAlpha | kPlays},
    OutputKind{".webp", by_module<&AvModule::webp_output>, kPictures | kAlpha | kPlays, "",
               kMaxFrameRate_webp},
    OutputKind{".png", png_output, kPictures | kAlpha | kNumbers,
               " with a number field such as %06d"},
    OutputKind{".svg", svg_output, kPictures | kAlpha | kNumbers | kVector, " likewise"},
    OutputKind{".pdf", pdf_output, kPictures | kAlpha | kVector | kWhole,
               " (a page for each frame)"},
    OutputKind{".y4m", y4m_output, kPictures},
    OutputKind{"-", y4m_output, kPictures | kWhole, " (y4m on standard output)"},
    OutputKind{".framehash", by_module<&AvModule::framehash_output>, kPictures | kAlpha},
    OutputKind{"null", null_output, kAlpha | kWhole},
    OutputKind{".wav", wav_output, kSound | kAlpha | kWhole, " (sound alone)"},
};

/// Null if there is none.
const OutputKind* find_kind(std::string_view output) {
  for (const OutputKind& kind : kOutputKinds) {
    if (kind.is_file() ? has_ending(output, kind.ending) : output == kind.ending) return &kind;
  }
  return nullptr;
}

bool is_of_kind(std::string_view output, unsigned flags) {
  const OutputKind* const kind = find_kind(output);
  return kind != nullptr && kind->has(flags);
}

/// The kinds with these flags, as a message lists them.
std::string names(unsigned flags) {
  std::string names;
  for (const OutputKind& kind : kOutputKinds) {
    if (!kind.has(flags)) continue;
    names += fmt::format("{}{}{}{}", names.empty() ? "" : ", ", kind.is_file() ? "*" : "",
                         kind.ending, kind.note);
  }
  return names;
}

std::string size_problem(const VideoFormat& format) {
  const auto fits = [](int side) { return side >= 1 && side <= kMaxSide_px; };
  const std::int64_t pixels = std::int64_t{format.width_px} * format.height_px;
  if (fits(format.width_px) && fits(format.height_px) && pixels <= kMaxFrame_px) return {};
  return fmt::format(
      "output: size {}x{} is out of range: use sides of 1 to {} and at most {} pixels",
      format.width_px, format.height_px, kMaxSide_px, kMaxFrame_px);
}

std::string frame_rate_problem(const Rational& rate) {
  constexpr int kMaxTerm = std::numeric_limits<int>::max();  // of libav's rationals
  if (rate > 0 && rate.get_num() <= kMaxTerm && rate.get_den() <= kMaxTerm) return {};
  return fmt::format(
      "output: frame rate {} is out of range: use a number above 0 such as 60 or 30000/1001",
      rate.get_str());
}

/// What the kind of the output does not take.
void check_kind(const OutputKind& kind, const OutputRequest& request, Problems& problems) {
  const EncoderSettings& settings = request.settings;
  // @param listed  what the kinds have that could be written instead
  const auto check = [&](bool is_asked_for, unsigned flag, unsigned listed,
                         std::string_view problem) {
    if (!is_asked_for || kind.has(flag)) return;
    problems.add(
        fmt::format("output: '{}' {} or write one of: {}", request.name, problem, names(listed)));
  };
  check(settings.crf || settings.preset || settings.encoder, kSettings, kSettings,
        "has no use for crf, preset or encoder; leave them out");
  check(settings.plays.has_value(), kPlays, kPlays,
        "does not say how often it plays; leave that out");
  check(settings.start_number.has_value(), kNumbers, kNumbers,
        "has no numbers; leave the start number out");
  check(request.format.has_alpha, kAlpha, kPictures | kAlpha,
        "cannot be transparent; use an opaque background");
  check(!request.captions.empty(), kCaptions, kCaptions, "has no captions inside; leave them out");
  if (request.sound && !kind.has(kSound)) problems.add("output: " + no_sound_in(request.name));
}

}  // namespace

void ChunkEncoder::take(const ImageView& frame, std::span<const PixelRect> changed) {
  if (frame.width_px != width_px_ || frame.height_px != height_px_) {
    throw MediaError(fmt::format("output: cannot take frame: it is {}x{}, the output {}x{}",
                                 frame.width_px, frame.height_px, width_px_, height_px_));
  }
  convert(frame, changed);
}

void ChunkEncoder::take(const ImageView& frame) {
  const PixelRect whole{0, 0, frame.width_px, frame.height_px};
  take(frame, {&whole, 1});
}

void FrameSink::take_sound(PacketSource& /*sound*/) {
  throw MediaError("output: cannot take sound: it has no place for any");
}

void FrameCounter::take(const EncodedChunk& chunk) {
  if (!chunk.empty() && chunk.front().pts != frames_) {
    throw MediaError(fmt::format("output: cannot append the chunk of frame {}: frame {} is next",
                                 chunk.front().pts, frames_));
  }
  frames_ += std::ssize(chunk);
}

std::unique_ptr<PacketSource> reject_sound(SampleSource& /*samples*/) {
  throw MediaError("output: cannot encode sound: it has no place for any");
}

Output set_up_output(const std::string& name, const VideoFormat& format,
                     const EncoderSettings& settings, const std::optional<SoundFormat>& sound,
                     bool overwrite, const std::vector<Caption>& captions) {
  const OutputRequest request = {name, format, settings, sound, overwrite, captions};
  Problems problems;
  const OutputKind* const kind = find_kind(name);
  if (kind != nullptr) {
    check_kind(*kind, request, problems);
  } else {
    // render() sets up the MP4 of a page.
    problems.add(fmt::format(
        "output: cannot tell the kind of '{}' from its name; use one of: {}, *.html (a page)", name,
        names(0)));
  }
  problems.add(size_problem(format));
  problems.add(frame_rate_problem(format.frame_rate));
  problems.check();
  // cppcheck-suppress nullPointerRedundantCheck ; without a kind, check() throws
  return kind->set_up(request);
}

bool is_sound_alone(const std::string& name) { return has_ending(name, ".wav"); }

bool has_numbers(const std::string& name) { return is_of_kind(name, kNumbers); }
bool is_vector(const std::string& name) { return is_of_kind(name, kVector); }
bool has_parts(const std::string& name) { return !is_of_kind(name, kWhole); }

bool takes_sound(const std::string& name) {
  const OutputKind* const kind = find_kind(name);
  return kind == nullptr || kind->has(kSound);
}

std::string no_sound_in(const std::string& name) {
  return fmt::format("'{}' has no sound; write one of: {}, or leave the sound out", name,
                     names(kSound));
}

std::optional<int> max_frame_rate_of(const std::string& name) {
  const OutputKind* const kind = find_kind(name);
  if (kind == nullptr || kind->max_frame_rate == 0) return std::nullopt;
  return kind->max_frame_rate;
}

void claim_output(OverwriteCheck& check, const std::string& what, const std::string& name) {
  if (name == "null") return;
  if (name == "-") return check.writes_standard_output();
  if (has_numbers(name)) {
    try {
      const FramePattern pattern(name);
      return check.writes_some_of(what, name, pattern.folder(), names_of_pattern(name));
    } catch (const UsageError&) {  // set_up_output() says what is wrong
    }
  }
  check.writes(what, name);
}

std::vector<std::string> media_library_versions() {
  std::vector<std::string> versions = av_module().library_versions();
  versions.push_back(std::string("zlib ") + zlibVersion());
  return versions;
}

}  // namespace piblocks
