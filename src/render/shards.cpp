// Shards of a rendering, which are made anywhere and become the one output.
// In: a job, or the files of its shards. Out: what the header of a shard says of its job; the
// output.
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/version.hpp>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "core/overwrite_check.hpp"
#include "core/stop.hpp"
#include "draw/canvas.hpp"
#include "media/libav/av_module.hpp"
#include "media/mp4/coded_sound.hpp"
#include "media/output/output.hpp"
#include "media/output/shard_file.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

/// Stands for a setting that was not given.
constexpr const char* kDefault = "default";

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
  for (Segment& segment : std::get<Storyboard>(script).segments) {
    if (auto* const scenes = std::get_if<Scenes>(&segment.content)) {
      for (Scene& scene : *scenes) scene = with_logo_by_content(std::move(scene));
    }
  }
  return script;
}

/// The file of a shard, called a part in messages.
struct ShardFile {
  std::string path;
  ShardHeader header;
  Shard shard = {};
};

/// What joining needs of a header.
struct JobDescription {
  VideoFormat format;
  EncoderSettings encoder;
  std::string signature;
  std::int64_t frame_count = 0;
  std::optional<SoundFormat> sound;
};

/// @throws UsageError if the header has no value of that name.
const std::string& value_of(const ShardFile& part, std::string_view name) {
  const auto at = std::ranges::find(part.header, name, &ShardHeader::value_type::first);
  if (at != part.header.end()) return at->second;
  throw UsageError(fmt::format("join: '{}' lacks '{}'", part.path, name));
}

std::optional<std::string> setting(const ShardFile& part, std::string_view name) {
  const std::string& value = value_of(part, name);
  return value == kDefault ? std::nullopt : std::optional(value);
}

[[noreturn]] void throw_invalid(const ShardFile& part, const std::string& name) {
  throw UsageError(
      fmt::format("join: '{}' has the invalid {} {}", part.path, name, value_of(part, name)));
}

Rational rational(const ShardFile& part, const std::string& name) {
  try {
    return parse_rational(value_of(part, name));
  } catch (const UsageError&) {
    throw_invalid(part, name);
  }
}

/// @throws UsageError unless the value is a whole number from `low` to `high`.
std::int64_t number(const ShardFile& part, const std::string& name, std::int64_t high,
                    std::int64_t low = 1) {
  const Rational value = rational(part, name);
  if (value.get_den() == 1 && value >= to_integer(low) && value <= to_integer(high))
    return value.get_num().get_si();
  throw_invalid(part, name);
}

/// "2/3" as render() wrote it.
Shard number_of(const ShardFile& part) {
  const std::string& text = value_of(part, "part");
  const char* const end = text.data() + text.size();
  Shard result;
  auto read = std::from_chars(text.data(), end, result.number);
  if (read.ec == std::errc() && read.ptr != end && *read.ptr == '/') {
    read = std::from_chars(read.ptr + 1, end, result.count);
    const bool is_whole = read.ec == std::errc() && read.ptr == end;
    if (is_whole && result.number >= 1 && result.number <= result.count) return result;
  }
  throw UsageError(fmt::format("join: '{}' has the invalid part '{}'", part.path, text));
}

/// In the order of the shards. Closes each file again: there may be more than a process can have
/// open.
std::vector<ShardFile> read_headers(const std::vector<std::string>& paths) {
  std::vector<ShardFile> parts;
  for (const std::string& path : paths) {
    ShardFile& part = parts.emplace_back(ShardFile{path, ShardReader(path).header()});
    part.shard = number_of(part);
  }
  std::ranges::stable_sort(parts, {}, [](const ShardFile& part) { return part.shard.number; });
  return parts;
}

/// The first name whose value differs or that one of them lacks; empty if there is none.
std::string difference(const ShardHeader& one, const ShardHeader& other) {
  const auto [a, b] = std::ranges::mismatch(one, other, [](const auto& left, const auto& right) {
    return left == right || (left.first == "part" && right.first == "part");
  });
  if (a != one.end()) return a->first;
  return b != other.end() ? b->first : std::string();
}

void check_same_job(const std::vector<ShardFile>& parts) {
  const ShardFile& first = parts.front();
  for (const ShardFile& part : parts) {
    std::string name = difference(first.header, part.header);
    if (name.empty() && part.shard.count != first.shard.count) name = "number of parts";
    if (name.empty()) continue;
    throw UsageError(fmt::format("join: '{}' and '{}' are of different jobs: they differ in {}",
                                 first.path, part.path, name));
  }
}

void check_all_there(const std::vector<ShardFile>& parts) {
  std::vector<std::string> problems;
  auto next = parts.begin();
  const int count = parts.front().shard.count;
  for (int number = 1; number <= count; ++number) {
    if (next == parts.end() || next->shard.number != number) {
      problems.push_back(fmt::format("join: part {} of {} is missing", number, count));
      if (problems.size() == 10) break;  // nobody wants to read more
      continue;
    }
    const auto& path = next->path;
    for (++next; next != parts.end() && next->shard.number == number; ++next) {
      problems.push_back(fmt::format("join: '{}' and '{}' are both part {} of {}", path, next->path,
                                     number, count));
    }
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
}

/// The signature of an output without its encoder's headers, which are hexadecimal digits.
std::string in_words(std::string_view signature) {
  std::string words;
  while (!signature.empty()) {
    const std::size_t end = std::min(signature.find(", "), signature.size());
    const std::string_view piece = signature.substr(0, end);
    signature.remove_prefix(std::min(end + 2, signature.size()));
    const bool is_header = piece.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    if (!is_header) words += fmt::format("{}{}", words.empty() ? "" : ", ", piece);
  }
  return words;
}

void check_output(const std::vector<ShardFile>& parts, const std::string& name,
                  const Output& output, const JobDescription& job) {
  OverwriteCheck check;
  for (const ShardFile& part : parts) check.reads("the part", part.path);
  claim_output(check, "join: output", name);
  check.check();
  if (output.signature == job.signature) return;
  const std::string made = in_words(job.signature);
  const std::string wanted = in_words(output.signature);
  if (made != wanted) {
    throw UsageError(fmt::format(
        "join: the parts are of {}, and '{}' is {} here; choose a name of the kind that they were "
        "rendered for, on a machine with the same libraries",
        made, name, wanted));
  }
  throw UsageError(fmt::format(
      "join: the parts are of {} with other headers than the encoder writes here; join them on a "
      "machine with the library that they were rendered with",
      made));
}

/// The sound that the first shard of a rendering has for all of them.
class ShardSound final : public PacketSource {
 public:
  explicit ShardSound(const std::string& path) : reader_(path) {}

  std::optional<Packet> next() override {
    if (next_ == packets_.size()) {
      auto packets = reader_.next_sound();
      if (!packets || packets->empty()) return std::nullopt;
      packets_ = std::move(*packets);
      next_ = 0;
    }
    return std::move(packets_[next_++]);
  }

 private:
  ShardReader reader_;
  EncodedChunk packets_;
  std::size_t next_ = 0;
};

/// Null if there is none.
std::unique_ptr<PacketSource> sound_of(const JobDescription& job, const ShardFile& first) {
  if (!job.sound) return nullptr;
  if (job.sound->coded) return packets_of(*job.sound->coded, *job.sound);
  return std::make_unique<ShardSound>(first.path);
}

JobDescription read_description(const ShardFile& part) {
  JobDescription job;
  job.format.width_px = static_cast<int>(number(part, "view.width", kMaxSide_px));
  job.format.height_px = static_cast<int>(number(part, "view.height", kMaxSide_px));
  job.format.frame_rate = rational(part, "view.fps");
  if (job.format.frame_rate <= 0) throw_invalid(part, "view.fps");
  job.format.has_alpha = value_of(part, "view.background") == "transparent";
  if (setting(part, "crf")) job.encoder.crf = to_double(rational(part, "crf"));
  job.encoder.preset = setting(part, "preset");
  job.encoder.encoder = setting(part, "encoder");
  if (setting(part, "start-number")) {
    job.encoder.start_number = int(number(part, "start-number", kMaxStartNumber, 0));
  }
  if (setting(part, "plays")) job.encoder.plays = int(number(part, "plays", kMaxPlays));
  job.signature = value_of(part, "output");
  job.frame_count = number(part, "frames", kMaxFrames);
  if (value_of(part, "sound.on") == "true") {
    job.sound = sound_format({0, job.frame_count - 1}, job.format.frame_rate);
  }
  return job;
}

}  // namespace

ShardHeader describe(const RenderJob& job, const Output& output, std::int64_t frame_count) {
  ShardHeader header;
  header.emplace_back("piblocks", kVersion);
  const Script script = with_logos_by_content(job.script);
  for (auto& [key, value] : std::visit([](const auto& any) { return describe(any); }, script)) {
    if (!key.starts_with(kGoldenKeys)) header.emplace_back(std::move(key), std::move(value));
  }
  header.emplace_back("view.width", std::to_string(view_of(script).width_px));
  header.emplace_back("view.height", std::to_string(view_of(script).height_px));
  header.emplace_back("frames", std::to_string(frame_count));
  const auto& crf = job.encoder.crf;
  header.emplace_back("crf", crf ? rational_from_decimal(*crf).get_str() : kDefault);
  header.emplace_back("preset", job.encoder.preset.value_or(kDefault));
  header.emplace_back("encoder", job.encoder.encoder.value_or(kDefault));
  for (const auto& [name, value] : {std::pair("plays", job.encoder.plays),
                                    std::pair("start-number", job.encoder.start_number)}) {
    header.emplace_back(name, value ? std::to_string(*value) : kDefault);
  }
  header.emplace_back("painter", painter_fingerprint());
  header.emplace_back("output", output.signature);
  return header;
}

bool has_shard(const std::string& path, const ShardHeader& header, const std::stop_token& stop) {
  if (!is_shard_file(path)) return false;
  ShardReader reader(path);
  std::string name = difference(reader.header(), header);
  if (name.empty() && reader.header() != header) name = "part";  // of a file that was renamed
  if (!name.empty()) {
    throw UsageError(
        fmt::format("resume: '{}' is of another job: it differs in {}; give the same command, or "
                    "leave resume out to replace the part",
                    path, name));
  }
  try {
    while (reader.next()) check_stop(stop);
    return true;
  } catch (const IoError&) {
    return false;  // damaged
  }
}

Rendered join(const std::vector<std::string>& parts, const std::string& output,
              const std::stop_token& stop, bool overwrite) {
  return join_with_sound(parts, output, nullptr, stop, overwrite);
}

Rendered join_with_sound(const std::vector<std::string>& parts, const std::string& output,
                         const std::shared_ptr<const CodedSound>& sound,
                         const std::stop_token& stop, bool overwrite) {
  if (parts.empty()) throw UsageError("join: no parts are given");
  if (is_page(output)) {
    throw UsageError(
        fmt::format("join: '{}' cannot be made of parts; render the page whole", output));
  }
  const std::vector<ShardFile> in_order = read_headers(parts);
  check_same_job(in_order);
  check_all_there(in_order);
  JobDescription job = read_description(in_order.front());
  if (sound) {
    job.sound = sound_format({0, job.frame_count - 1}, job.format.frame_rate);
    job.sound->coded = sound;
  }
  const Output joined = set_up_output(output, job.format, job.encoder, job.sound, overwrite);
  check_output(in_order, output, joined, job);

  const auto sink = joined.open({job.frame_count});
  const std::unique_ptr<PacketSource> packets = sound_of(job, in_order.front());
  if (packets) sink->take_sound(*packets);
  std::int64_t frames = 0;
  for (const ShardFile& part : in_order) {
    ShardReader reader(part.path);
    while (const auto chunk = reader.next()) {
      check_stop(stop);
      sink->append(*chunk);
      frames += static_cast<std::int64_t>(chunk->size());
    }
  }
  if (frames != job.frame_count) {
    throw IoError(fmt::format("join: the parts have {} frames, the whole {}; render them again",
                              frames, job.frame_count));
  }
  sink->finish();
  return {.frame_count = frames, .profile = {}, .aftermath = sink->aftermath()};
}

}  // namespace piblocks
