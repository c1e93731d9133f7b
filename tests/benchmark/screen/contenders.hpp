// The encoders that are compared, behind one interface.
// In: pictures. Out: the bytes of each.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "screen/recording.hpp"

namespace piblocks::benchmark {

/// One stream of one thread, without delay: every picture gives its bytes at once.
class PictureEncoder {
 public:
  virtual ~PictureEncoder() = default;
  /// @return the access unit, valid until the next call; with start codes, the headers first.
  ///         Nothing if the picture was left out.
  virtual std::span<const std::uint8_t> encode(const Picture& picture) = 0;
  /// How many were quantised more coarsely than asked for.
  virtual int coarser_pictures() const { return 0; }
};

struct Contender {
  std::string name;
  std::string version;
  std::string settings;  ///< but the quantiser
  bool has_qp;           ///< otherwise one setting, of whatever quality
  std::function<std::unique_ptr<PictureEncoder>(int qp)> make;
};

/// The library as an application uses it, and told that all of each picture may have changed.
std::vector<Contender> piblocks_contenders();
std::vector<Contender> x264_contenders();
/// Nothing where it was not installed when this was built.
std::optional<Contender> openh264_contender();

}  // namespace piblocks::benchmark
