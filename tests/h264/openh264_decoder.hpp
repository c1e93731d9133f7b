// openh264's decoder, which shares no code with libavcodec's.
#pragma once

#include <wels/codec_api.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "h264/stream_fixture.hpp"

namespace piblocks::h264 {

class OpenH264Decoder {
 public:
  /// @param headers  with start codes; sent before the first picture.
  explicit OpenH264Decoder(const std::vector<std::uint8_t>& headers) : headers_(headers) {
    ISVCDecoder* decoder = nullptr;
    if (WelsCreateDecoder(&decoder) != 0) throw std::runtime_error("no decoder from openh264");
    decoder_.reset(decoder);
    int level = WELS_LOG_QUIET;
    decoder->SetOption(DECODER_OPTION_TRACE_LEVEL, &level);
    SDecodingParam parameters{};
    parameters.eEcActiveIdc = ERROR_CON_DISABLE;
    parameters.sVideoProperty.eVideoBsType = VIDEO_BITSTREAM_AVC;
    if (decoder->Initialize(&parameters) != 0) throw std::runtime_error("openh264 does not start");
  }

  /// The cropped picture of one access unit; nothing if it is damaged.
  std::optional<ShownPicture> decode(const std::vector<std::uint8_t>& unit) {
    std::vector<std::uint8_t> bytes = std::move(headers_);
    headers_.clear();
    bytes.insert(bytes.end(), unit.begin(), unit.end());
    std::array<unsigned char*, 3> planes{};
    SBufferInfo info{};
    const auto state = decoder_->DecodeFrameNoDelay(bytes.data(), static_cast<int>(bytes.size()),
                                                    planes.data(), &info);
    if (state != dsErrorFree || info.iBufferStatus != 1) return std::nullopt;
    const SSysMEMBuffer& shown = info.UsrData.sSystemBuffer;
    return ShownPicture{.width = shown.iWidth,
                        .height = shown.iHeight,
                        .planes = {planes[0], planes[1], planes[2]},
                        .strides = {shown.iStride[0], shown.iStride[1], shown.iStride[1]}};
  }

 private:
  struct Destroy {
    void operator()(ISVCDecoder* decoder) const {
      decoder->Uninitialize();
      WelsDestroyDecoder(decoder);
    }
  };
  std::unique_ptr<ISVCDecoder, Destroy> decoder_;
  std::vector<std::uint8_t> headers_;
};

}  // namespace piblocks::h264
