#include "render/job_description.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/version.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

#include "draw/canvas.hpp"
#include "media/libav/av_module.hpp"
#include "render/film.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

constexpr const char* kTransparent = "transparent";

/// What is kept of a scene to compare it with does not change its frames.
constexpr std::string_view kGoldenKeys = "golden.";

/// The logo by its pixels in place of its file, which may have another name elsewhere, and other
/// pixels later.
Scene with_logo_by_content(Scene scene) {
  if (const auto logo = read_logo(scene)) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(logo->words.data());
    scene.show.logo = fmt::format("{}x{} {}", logo->width_px, logo->height_px,
                                  hash_of_bytes({bytes, 4 * logo->words.size()}));
  }
  return scene;
}

Script with_logos_by_content(Script script) {
  if (auto* const scene = std::get_if<Scene>(&script)) return with_logo_by_content(*scene);
  auto& story = std::get<Storyboard>(script);
  for (Segment& segment : story.segments) {
    auto* const scenes = std::get_if<Scenes>(&segment.content);
    if (scenes == nullptr) continue;
    for (Scene& scene : *scenes) scene = with_logo_by_content(std::move(scene));
  }
  return script;
}

void describe(const Script& script, ShardHeader& header) {
  const Script described = with_logos_by_content(script);
  for (auto& [key, value] : std::visit([](const auto& any) { return describe(any); }, described)) {
    if (!key.starts_with(kGoldenKeys)) header.emplace_back(std::move(key), std::move(value));
  }
  header.emplace_back("view.width", std::to_string(view_of(script).width_px));
  header.emplace_back("view.height", std::to_string(view_of(script).height_px));
}

/// Stands for a setting that was not given.
constexpr const char* kDefault = "default";

void describe(const EncoderSettings& settings, ShardHeader& header) {
  const auto& crf = settings.crf;
  header.emplace_back("crf", crf ? rational_from_decimal(*crf).get_str() : kDefault);
  header.emplace_back("preset", settings.preset.value_or(kDefault));
  header.emplace_back("encoder", settings.encoder.value_or(kDefault));
}

std::optional<std::string> setting(const ShardInfo& part, const std::string& name) {
  const std::string& value = value_of(part, name);
  return value == kDefault ? std::nullopt : std::optional(value);
}

/// @throws UsageError unless the value is a whole number from 1 to `high`.
std::int64_t number(const ShardInfo& part, const std::string& name, std::int64_t high) {
  const Rational value = parse_rational(value_of(part, name));
  if (value.get_den() == 1 && value >= 1 && value <= high) return value.get_num().get_si();
  throw UsageError(
      fmt::format("join: '{}' has the invalid {} {}", part.path, name, to_text(value)));
}

}  // namespace

ShardHeader describe(const RenderJob& job, const Output& output, std::int64_t frame_count) {
  ShardHeader header;
  header.emplace_back("piblocks", kVersion);
  describe(job.script, header);
  header.emplace_back("frames", std::to_string(frame_count));
  describe(job.encoder, header);
  header.emplace_back("painter", painter_fingerprint());
  header.emplace_back("output", output.signature);
  return header;
}

const std::string& value_of(const ShardInfo& part, const std::string& name) {
  const auto at = std::ranges::find(part.header, name, &ShardHeader::value_type::first);
  if (at != part.header.end()) return at->second;
  throw UsageError(fmt::format("join: '{}' lacks '{}'", part.path, name));
}

JobDescription read_description(const ShardInfo& part) {
  JobDescription job;
  job.format.width_px = static_cast<int>(number(part, "view.width", kMaxSide_px));
  job.format.height_px = static_cast<int>(number(part, "view.height", kMaxSide_px));
  job.format.frame_rate = parse_rational(value_of(part, "view.fps"));
  job.format.has_alpha = value_of(part, "view.background") == kTransparent;
  if (const auto crf = setting(part, "crf")) job.encoder.crf = to_double(parse_rational(*crf));
  job.encoder.preset = setting(part, "preset");
  job.encoder.encoder = setting(part, "encoder");
  job.signature = value_of(part, "output");
  job.frame_count = number(part, "frames", kMaxFrames);
  job.has_sound = value_of(part, "sound.on") == "true";
  return job;
}

}  // namespace piblocks
