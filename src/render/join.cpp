// Parts of a rendering, made anywhere, become the one output.
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <charconv>

#include "core/overwrite_check.hpp"
#include "media/output/output.hpp"
#include "media/output/shard_file.hpp"
#include "render/film_sound.hpp"
#include "render/job_description.hpp"
#include "render/renderings.hpp"

namespace piblocks {
namespace {

/// "2/3" as render() wrote it.
Shard number_of(const ShardInfo& part) {
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

struct NumberedShard {
  Shard number;
  ShardInfo info;
};

/// Closes each file again: there may be more than a process can have open.
std::vector<NumberedShard> read_headers(const std::vector<std::string>& paths) {
  std::vector<NumberedShard> parts;
  for (const std::string& path : paths) {
    ShardInfo info{path, ShardReader(path).header()};
    const Shard number = number_of(info);
    parts.push_back({number, std::move(info)});
  }
  std::ranges::stable_sort(parts, {}, [](const NumberedShard& part) { return part.number.number; });
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

void check_same_job(const std::vector<NumberedShard>& parts) {
  const ShardInfo& first = parts.front().info;
  for (const auto& [number, info] : parts) {
    std::string name = difference(first.header, info.header);
    if (name.empty() && number.count != parts.front().number.count) name = "number of parts";
    if (name.empty()) continue;
    throw UsageError(fmt::format("join: '{}' and '{}' are of different jobs: they differ in {}",
                                 first.path, info.path, name));
  }
}

void check_all_there(const std::vector<NumberedShard>& parts) {
  std::vector<std::string> problems;
  auto next = parts.begin();
  const int count = parts.front().number.count;
  for (int number = 1; number <= count; ++number) {
    if (next == parts.end() || next->number.number != number) {
      problems.push_back(fmt::format("join: part {} of {} is missing", number, count));
      // So many that nobody wants to read them.
      if (problems.size() == 10) break;
      continue;
    }
    const auto& path = next->info.path;
    for (++next; next != parts.end() && next->number.number == number; ++next) {
      problems.push_back(fmt::format("join: '{}' and '{}' are both part {} of {}", path,
                                     next->info.path, number, count));
    }
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
}

void check_output(const std::vector<NumberedShard>& parts, const std::string& name,
                  const Output& output, const JobDescription& job) {
  OverwriteCheck check;
  for (const auto& [number, info] : parts) check.reads("the part", info.path);
  claim_output(check, "join: output", name);
  check.check();
  if (output.signature == job.signature) return;
  throw UsageError(
      fmt::format("join: the parts were made for another output than '{}' is here: '{}', not '{}'",
                  name, job.signature, output.signature));
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

std::optional<SoundFormat> sound_of(const JobDescription& job) {
  if (!job.has_sound) return std::nullopt;
  return sound_format(job.frame_count, job.format.frame_rate);
}

}  // namespace

std::int64_t join(const std::vector<std::string>& parts, const std::string& output,
                  const std::stop_token& stop) {
  if (parts.empty()) throw UsageError("join: no parts are given");
  if (is_page(output)) {
    throw UsageError(
        fmt::format("join: '{}' cannot be made of parts; render the page whole", output));
  }
  const std::vector<NumberedShard> in_order = read_headers(parts);
  check_same_job(in_order);
  check_all_there(in_order);
  const JobDescription job = read_description(in_order.front().info);
  const Output joined = set_up_output(output, job.format, job.encoder, sound_of(job));
  check_output(in_order, output, joined, job);

  const auto sink = joined.open();
  std::optional<ShardSound> sound;
  if (job.has_sound) sink->take_sound(sound.emplace(in_order.front().info.path));
  std::int64_t frames = 0;
  for (const auto& [number, info] : in_order) {
    ShardReader reader(info.path);
    while (const auto chunk = reader.next()) {
      if (stop.stop_requested()) throw Interrupted("join: interrupted");
      sink->append(*chunk);
      frames += static_cast<std::int64_t>(chunk->size());
    }
  }
  if (frames != job.frame_count) {
    throw IoError(fmt::format("join: the parts have {} frames, the whole {}; render them again",
                              frames, job.frame_count));
  }
  sink->finish();
  return frames;
}

}  // namespace piblocks
