#include "h264/mp4_writer.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "h264/encoder.hpp"
#include "h264/mp4_tracks.hpp"
#include "h264/nal_unit.hpp"

namespace piblocks::h264 {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::int64_t kMaxInt = std::numeric_limits<std::int32_t>::max();
/// The index stays below 2^32 bytes, also if all pictures are key frames.
constexpr std::int64_t kMaxPictures = 500'000'000;
constexpr std::int64_t kMaxChunks = 4096;
constexpr std::uint64_t kFileType_bytes = 32;
constexpr std::uint64_t kBoxHeader_bytes = 8;
constexpr std::uint64_t kLargeBoxHeader_bytes = 16;
constexpr std::size_t kDataBlock_bytes = 65536;
constexpr std::size_t kSizesBlock_bytes = 4096;

std::int64_t in_range(std::int64_t value, std::int64_t most, std::string_view name) {
  if (1 <= value && value <= most) return value;
  throw Error("h264: " + std::string(name) + " of an MP4 file is " + std::to_string(value) +
              ", not in [1, " + std::to_string(most) + "]");
}

bool has_type(Bytes unit, UnitType type) { return (unit[0] & 31) == static_cast<int>(type); }

/// Parameter sets of the track: one of each.
void take_headers(Bytes headers, TrackFacts& facts) {
  const auto take_set = [](Bytes unit, std::vector<std::uint8_t>& set) {
    if (!set.empty()) throw Error("h264: the headers of an MP4 file have two sets of one type");
    in_range(std::ssize(unit), 65535, "the size of a parameter set");
    set.assign(unit.begin(), unit.end());
  };
  for (Bytes unit = take_unit(headers); !unit.empty(); unit = take_unit(headers)) {
    if (has_type(unit, UnitType::sequence_parameters)) take_set(unit, facts.sequence_set);
    if (has_type(unit, UnitType::picture_parameters)) take_set(unit, facts.picture_set);
  }
  if (facts.sequence_set.size() < 4 || facts.picture_set.empty()) {
    throw Error("h264: the headers of an MP4 file lack a parameter set");
  }
  const int profile = facts.sequence_set[1];
  if (profile == 66 || profile == 77 || profile == 88) return;
  throw Error("h264: profile_idc of an MP4 file is " + std::to_string(profile) +
              ", not 66, 77 or 88");  // avcC of other profiles has more fields
}

TrackFacts facts_of(const Mp4Track& track) {
  TrackFacts facts{};
  facts.width_px = in_range(track.width_px, 65535, "width_px");
  facts.height_px = in_range(track.height_px, 65535, "height_px");
  facts.max_pictures = in_range(track.max_pictures, kMaxPictures, "max_pictures");
  facts.time_scale = mp4_time_scale(in_range(track.rate.numerator, kMaxInt, "rate.numerator"));
  const std::int64_t factor = facts.time_scale / track.rate.numerator;
  facts.picture_duration =
      factor * in_range(track.rate.denominator, kMaxInt / factor, "rate.denominator");
  // A chunk is a second, if there are not too many.
  facts.chunk_pictures = std::max(
      {std::int64_t{1}, (facts.time_scale + facts.picture_duration / 2) / facts.picture_duration,
       (facts.max_pictures - 1) / kMaxChunks + 1});
  facts.max_key_frames = track.max_key_frames == 0
                             ? facts.max_pictures
                             : in_range(track.max_key_frames, facts.max_pictures, "max_key_frames");
  take_headers(track.headers, facts);
  return facts;
}

void check_opus(const Mp4Sound& sound) {
  constexpr std::string_view kMagic = "OpusHead";
  constexpr std::size_t kHeader_bytes = 19;
  const std::vector<std::uint8_t>& header = sound.config;
  const bool is_header = header.size() == kHeader_bytes &&
                         std::ranges::equal(kMagic, Bytes(header).first(kMagic.size())) &&
                         header[9] == 2 && header.back() == 0;
  if (is_header && sound.rate_hz == 48000) return;
  throw Error(
      "h264: Opus of an MP4 file has no header of two channels in mapping family 0, or not 48000 "
      "Hz");
}

std::optional<Mp4Sound> checked(const std::optional<Mp4Sound>& sound) {
  if (!sound) return sound;
  in_range(sound->rate_hz, 65535, "sound.rate_hz");
  in_range(std::ssize(sound->config), 64, "the size of sound.config");
  if (sound->codec == Mp4SoundCodec::opus) check_opus(*sound);
  in_range(sound->packet_samples, 65535, "sound.packet_samples");
  in_range(sound->delay + 1, 65536, "sound.delay + 1");
  in_range(sound->samples, std::int64_t{1} << 47, "sound.samples");
  return sound;
}

std::span<const Mp4Caption> checked(std::span<const Mp4Caption> captions, std::int64_t pictures) {
  std::int64_t earliest = 0;
  for (const Mp4Caption& caption : captions) {
    if (caption.picture < earliest || caption.picture >= pictures) {
      throw Error("h264: captions of an MP4 file are not in order, or begin after its end");
    }
    in_range(std::ssize(caption.text) + 1, 65536, "the size of a caption + 1");
    earliest = caption.picture + 1;
  }
  return captions;
}

/// Bytes that follow each other in the file, written in blocks.
class Blocks {
 public:
  Blocks(std::uint64_t offset, std::size_t block_bytes) : offset_(offset) {
    waiting_.reserve(block_bytes);
  }
  void put(Bytes bytes, const Mp4Writer::WriteAt& write_at) {
    if (waiting_.size() + bytes.size() > waiting_.capacity()) flush(write_at);
    if (bytes.size() > waiting_.capacity()) {
      write_at(std::exchange(offset_, offset_ + bytes.size()), bytes);
    } else {
      waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    }
  }
  void put_32(std::uint64_t value, const Mp4Writer::WriteAt& write_at) {
    const auto byte = [&](int shift) { return static_cast<std::uint8_t>(value >> shift); };
    put(std::array{byte(24), byte(16), byte(8), byte(0)}, write_at);
  }
  void flush(const Mp4Writer::WriteAt& write_at) {
    if (waiting_.empty()) return;
    write_at(offset_, waiting_);
    offset_ += waiting_.size();
    waiting_.clear();
  }

 private:
  std::uint64_t offset_;  // of the first byte that waits
  std::vector<std::uint8_t> waiting_;
};

}  // namespace

std::int64_t mp4_time_scale(std::int64_t rate_numerator) {
  constexpr std::int64_t kFewestUnits = 10'000;
  while (rate_numerator < kFewestUnits) rate_numerator *= 2;
  return rate_numerator;
}

void raise_level(std::span<std::uint8_t> sequence, const Level* level) {
  assert(sequence.size() >= 4);
  if (level == nullptr || level->idc <= sequence[3]) return;
  sequence[3] = static_cast<std::uint8_t>(level->idc);
}

class Mp4Writer::Impl {
 public:
  Impl(const Mp4Track& track, WriteAt write_at)
      : track_(facts_of(track)),
        sound_(checked(track.sound)),
        write_at_(std::move(write_at)),
        levels_(track.width_px, track.height_px, track.rate, track_.sequence_set[1]),
        seconds_((track_.time_scale - 1) / track_.picture_duration + 1),
        sizes_start_(kFileType_bytes + kBoxHeader_bytes + index_room(track_)),
        sizes_(sizes_start_, kSizesBlock_bytes) {
    if (!track.captions.empty()) {
      texts_.emplace(track_, checked(track.captions, track_.max_pictures));
    }
    data_start_ = sizes_start_ + 4 * static_cast<std::uint64_t>(track_.max_pictures) +
                  room_of_others() + kBoxHeader_bytes + kLargeBoxHeader_bytes;
    data_.emplace(data_start_, kDataBlock_bytes);
    if (texts_) put_data(texts_->data());
  }

  void append(Bytes unit, bool is_idr) {
    check_room(tables_.pictures, track_.max_pictures, "pictures");
    if (is_idr) check_room(std::ssize(tables_.key_frames), track_.max_key_frames, "key frames");
    const std::uint64_t size_bytes = split(unit);
    if (tables_.pictures % track_.chunk_pictures == 0) {
      put_sound();
      tables_.chunks.push_back(data_start_ + data_bytes_);
    }
    for (const Bytes part : parts_) {
      data_->put_32(part.size(), write_at_);
      data_->put(part, write_at_);
    }
    data_bytes_ += size_bytes;
    sizes_.put_32(size_bytes, write_at_);
    ++tables_.pictures;
    if (is_idr) tables_.key_frames.push_back(static_cast<std::uint32_t>(tables_.pictures));
    tables_.data_bytes += size_bytes;
    levels_.take(static_cast<std::int64_t>(size_bytes));
    seconds_.take(size_bytes);
  }

  void append_sound(Bytes packet) {
    if (!sound_) throw Error("h264: an MP4 file has no sound");
    check_room(std::ssize(packets_.sizes), static_cast<std::int64_t>(max_packets(*sound_)),
               "packets of sound");
    packets_.sizes.push_back(static_cast<std::uint32_t>(packet.size()));
    ++waiting_packets_;
    waiting_sound_.insert(waiting_sound_.end(), packet.begin(), packet.end());
  }

  void finish() {
    if (tables_.pictures == 0) throw Error("h264: an MP4 file has no picture");
    if (sound_ && packets_.sizes.empty()) throw Error("h264: the sound of an MP4 file is missing");
    put_sound();
    data_->flush(write_at_);
    sizes_.flush(write_at_);
    raise_level(track_.sequence_set, levels_.level());
    tables_.max_second_bytes = seconds_.most_bytes();
    const std::vector<std::uint8_t> others = other_tracks();
    const std::vector<std::uint8_t> index =
        make_index(track_, tables_,
                   {.duration = duration(),
                    .tracks = 1U + (sound_ ? 1U : 0U) + (texts_ ? 1U : 0U),
                    .others_bytes = others.size()});
    const std::uint64_t index_start = sizes_start_ - index.size();
    const std::uint64_t sizes_end = sizes_start_ + 4 * static_cast<std::uint64_t>(tables_.pictures);
    write_at_(index_start, index);
    if (!others.empty()) write_at_(sizes_end, others);
    write_data_header(sizes_end + others.size());
    write_start(index_start);
  }

 private:
  static void check_room(std::int64_t count, std::int64_t most, std::string_view name) {
    if (count < most) return;
    throw Error("h264: an MP4 file has room for " + std::to_string(most) + " " + std::string(name));
  }
  /// Finds the NAL units that become parts of the file. @return their size with their lengths.
  std::uint64_t split(Bytes unit) {
    parts_.clear();
    std::uint64_t size_bytes = 0;
    for (Bytes part = take_unit(unit); !part.empty(); part = take_unit(unit)) {
      if (is_left_out(part)) continue;
      parts_.push_back(part);
      size_bytes += 4 + part.size();
    }
    in_range(static_cast<std::int64_t>(size_bytes), std::int64_t{kMax32}, "the size of a picture");
    return size_bytes;
  }
  /// Whether the file says it elsewhere: parameter sets, and where access units begin.
  bool is_left_out(Bytes part) const {
    const bool is_sequence = has_type(part, UnitType::sequence_parameters);
    if (is_sequence || has_type(part, UnitType::picture_parameters)) {
      if (std::ranges::equal(part, is_sequence ? track_.sequence_set : track_.picture_set))
        return true;
      throw Error("h264: a picture of an MP4 file comes with other parameter sets");
    }
    return has_type(part, UnitType::access_unit_delimiter);
  }
  std::uint64_t room_of_others() const {
    const std::int64_t chunks = (track_.max_pictures - 1) / track_.chunk_pictures + 2;
    return (sound_ ? sound_track_room(*sound_, static_cast<std::uint64_t>(chunks)) : 0) +
           (texts_ ? texts_->room() : 0);
  }
  std::vector<std::uint8_t> other_tracks() const {
    std::vector<std::uint8_t> tracks;
    if (sound_) tracks = make_sound_track(*sound_, packets_, track_.time_scale);
    if (!texts_) return tracks;
    const std::vector<std::uint8_t> texts =
        texts_->make(sound_ ? 3 : 2, data_start_, tables_.pictures);
    tracks.insert(tracks.end(), texts.begin(), texts.end());
    return tracks;
  }
  std::uint64_t duration() const {
    return std::max(static_cast<std::uint64_t>(tables_.pictures * track_.picture_duration),
                    sound_ ? sound_duration(*sound_, track_.time_scale) : 0);
  }
  void put_data(Bytes bytes) {
    data_->put(bytes, write_at_);
    data_bytes_ += bytes.size();
  }
  /// The packets that wait, as a chunk.
  void put_sound() {
    if (waiting_packets_ == 0) return;
    packets_.chunks.push_back({data_start_ + data_bytes_, std::exchange(waiting_packets_, 0)});
    put_data(waiting_sound_);
    waiting_sound_.clear();
  }
  /// From the end of the index to the first of the data.
  void write_data_header(std::uint64_t index_end) {
    const bool is_large = data_bytes_ > kMax32 - kBoxHeader_bytes;
    const std::uint64_t size_bytes = is_large ? kLargeBoxHeader_bytes : kBoxHeader_bytes;
    BoxWriter gap;
    gap.box(
        "free", [] {}, data_start_ - size_bytes - index_end - kBoxHeader_bytes);
    write_at_(index_end, gap.bytes());

    BoxWriter header;
    header.put(is_large ? 1 : size_bytes + data_bytes_, 4);
    header.put("mdat");
    if (is_large) header.put(size_bytes + data_bytes_, 8);
    write_at_(data_start_ - size_bytes, header.bytes());
  }
  void write_start(std::uint64_t index_start) {
    BoxWriter start;
    start.box("ftyp", [&] {
      start.put("isom");
      start.put(512, 4);
      start.put("isomiso2avc1mp41");
    });
    start.box(
        "free", [] {}, index_start - kFileType_bytes - kBoxHeader_bytes);
    write_at_(0, start.bytes());
  }

  TrackFacts track_;
  std::optional<Mp4Sound> sound_;
  std::optional<TextTrack> texts_;
  WriteAt write_at_;
  LevelWatch levels_;
  SecondWatch seconds_;
  PictureTables tables_;
  SoundTables packets_;
  std::vector<std::uint8_t> waiting_sound_;
  std::uint64_t waiting_packets_ = 0;
  std::uint64_t sizes_start_;
  std::uint64_t data_start_ = 0;
  std::uint64_t data_bytes_ = 0;
  Blocks sizes_;
  std::optional<Blocks> data_;
  std::vector<Bytes> parts_;  // of the picture that is being appended
};

Mp4Writer::Mp4Writer(const Mp4Track& track, WriteAt write_at)
    : impl_(std::make_unique<Impl>(track, std::move(write_at))) {}
Mp4Writer::~Mp4Writer() = default;
void Mp4Writer::append(Bytes unit, bool is_idr) { impl_->append(unit, is_idr); }
void Mp4Writer::append_sound(Bytes packet) { impl_->append_sound(packet); }
void Mp4Writer::finish() { impl_->finish(); }

}  // namespace piblocks::h264
