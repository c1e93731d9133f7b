#include "h264/mp4_text.hpp"

#include <algorithm>

#include "h264/mp4_boxes.hpp"

namespace piblocks::h264 {
namespace {

/// How the texts look (3GPP TS 26.245, 5.16): white, centred below, as high as subtitles are.
class TextDescription : public TrackWriter {
 public:
  void put_sample_entry(std::uint64_t width_px, std::uint64_t height_px) {
    put_zeros(6);
    put(1, 2);     // data_reference_index
    put(0, 4);     // displayFlags
    put(1, 1);     // horizontal: centred
    put(0xff, 1);  // vertical: at the bottom
    put(0, 4);     // background: none
    put(0, 4);     // the box: from above and left
    put(height_px, 2);
    put(width_px, 2);
    put(0, 4);  // style of all characters
    put(1, 2);  // font
    put(0, 1);
    put(std::clamp<std::uint64_t>(height_px / 20, 8, 255), 1);
    put(0xffffffff, 4);
    box("ftab", [&] {
      put(1, 2);
      put(1, 2);
      put(10, 1);
      put("Sans-Serif");
    });
  }
};

}  // namespace

TextTrack::TextTrack(const TrackFacts& pictures, std::span<const Mp4Caption> captions)
    : track_(pictures) {
  const auto add = [&](std::int64_t start, std::string_view text) {
    BoxWriter sample;
    sample.put(text.size(), 2);
    sample.put(text);
    starts_.push_back(start);
    sizes_.push_back(static_cast<std::uint32_t>(sample.bytes().size()));
    data_.insert(data_.end(), sample.bytes().begin(), sample.bytes().end());
  };
  if (captions.empty() || captions.front().picture > 0) add(0, "");
  for (const Mp4Caption& caption : captions) add(caption.picture, caption.text);
}

std::vector<std::uint8_t> TextTrack::make(std::uint64_t id, std::uint64_t offset,
                                          std::int64_t pictures) const {
  const auto units = [&](std::int64_t count) {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(count, 0) * track_.picture_duration);
  };
  const auto width_px = static_cast<std::uint64_t>(track_.width_px);
  const auto height_px = static_cast<std::uint64_t>(track_.height_px);
  const Head head{id,
                  static_cast<std::uint64_t>(track_.time_scale),
                  units(pictures),
                  units(pictures),
                  0,
                  "sbtl",
                  "SubtitleHandler"};
  TextDescription track;
  const auto put_tables = [&] {
    track.box("stsd", [&] {
      track.put_all({0, 1});
      track.box("tx3g", [&] { track.put_sample_entry(width_px, height_px); });
    });
    track.box("stts", [&] {
      track.put_all({0, starts_.size()});
      for (std::size_t i = 0; i < starts_.size(); ++i) {
        const std::int64_t end = i + 1 < starts_.size() ? starts_[i + 1] : pictures;
        track.put_all({1, units(end - starts_[i])});
      }
    });
    const SampleChunk chunk{offset, starts_.size()};
    track.put_chunks({&chunk, 1});
    track.put_sizes(sizes_);
  };
  track.box("trak", [&] {
    track.put_track_header(head, 0, 2, width_px, height_px);
    track.put_track(
        head, [&] { track.box("nmhd", [&] { track.put_zeros(4); }); }, put_tables);
  });
  return track.bytes();
}

std::uint64_t TextTrack::room() const {
  return make(3, kMax32 + 1, track_.max_pictures).size() + TrackWriter::kLongTrack_bytes;
}

}  // namespace piblocks::h264
