#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <wels/codec_api.h>

#include "screen/contenders.hpp"

namespace piblocks::benchmark {
namespace {

struct Destroy {
  void operator()(ISVCEncoder* encoder) const {
    encoder->Uninitialize();
    WelsDestroySVCEncoder(encoder);
  }
};
using EncoderPtr = std::unique_ptr<ISVCEncoder, Destroy>;

void check(int code, const char* operation) {
  if (code != 0) throw Error(fmt::format("openh264: cannot {}: {}", operation, code));
}

SEncParamExt parameters_for(ISVCEncoder& encoder, int qp) {
  SEncParamExt parameters{};
  check(encoder.GetDefaultParams(&parameters), "tell its parameters");
  parameters.iUsageType = SCREEN_CONTENT_REAL_TIME;
  parameters.iPicWidth = kScreenWidth_px;
  parameters.iPicHeight = kScreenHeight_px;
  parameters.fMaxFrameRate = kPicturesPerSecond;
  parameters.iRCMode = RC_OFF_MODE;
  parameters.iMinQp = 0;
  parameters.iMaxQp = 51;
  parameters.iComplexityMode = LOW_COMPLEXITY;
  parameters.iMultipleThreadIdc = 1;
  parameters.bEnableFrameSkip = false;
  parameters.uiIntraPeriod = 0;  // one IDR picture
  SSpatialLayerConfig& layer = parameters.sSpatialLayers[0];
  layer.iVideoWidth = kScreenWidth_px;
  layer.iVideoHeight = kScreenHeight_px;
  layer.fFrameRate = kPicturesPerSecond;
  layer.iDLayerQp = qp;
  layer.sSliceArgument.uiSliceMode = SM_SINGLE_SLICE;
  return parameters;
}

class OpenH264Encoder : public PictureEncoder {
 public:
  explicit OpenH264Encoder(int qp) {
    ISVCEncoder* created = nullptr;
    check(WelsCreateSVCEncoder(&created), "start");
    encoder_.reset(created);
    int quiet = WELS_LOG_QUIET;
    encoder_->SetOption(ENCODER_OPTION_TRACE_LEVEL, &quiet);
    const SEncParamExt parameters = parameters_for(*encoder_, qp);
    check(encoder_->InitializeExt(&parameters), "take the parameters");
  }

  std::span<const std::uint8_t> encode(const Picture& picture) override {
    SSourcePicture source{};
    source.iColorFormat = videoFormatI420;
    source.iPicWidth = kScreenWidth_px;
    source.iPicHeight = kScreenHeight_px;
    source.iStride[0] = kScreenWidth_px;
    source.iStride[1] = source.iStride[2] = kScreenWidth_px / 2;
    source.pData[0] = const_cast<std::uint8_t*>(picture.y());
    source.pData[1] = const_cast<std::uint8_t*>(picture.cb());
    source.pData[2] = const_cast<std::uint8_t*>(picture.cr());
    source.uiTimeStamp = number_++ * 1000 / kPicturesPerSecond;
    SFrameBSInfo info{};
    check(encoder_->EncodeFrame(&source, &info), "encode");
    unit_.clear();
    for (int i = 0; i < info.iLayerNum; ++i) append(info.sLayerInfo[i]);
    return unit_;
  }

 private:
  void append(const SLayerBSInfo& layer) {
    std::size_t size_bytes = 0;
    for (int i = 0; i < layer.iNalCount; ++i) size_bytes += std::size_t(layer.pNalLengthInByte[i]);
    unit_.insert(unit_.end(), layer.pBsBuf, layer.pBsBuf + size_bytes);
  }

  EncoderPtr encoder_;
  std::vector<std::uint8_t> unit_;
  std::int64_t number_ = 0;
};

}  // namespace

std::optional<Contender> openh264_contender() {
  const OpenH264Version version = WelsGetCodecVersion();
  return Contender{.name = "openh264 screen content",
                   .version = fmt::format("openh264 {}.{}.{}", version.uMajor, version.uMinor,
                                          version.uRevision),
                   .settings = "SCREEN_CONTENT_REAL_TIME; LOW_COMPLEXITY; constant QP",
                   .has_qp = true,
                   .make = [](int qp) { return std::make_unique<OpenH264Encoder>(qp); }};
}

}  // namespace piblocks::benchmark
