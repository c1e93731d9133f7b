// What an encoder makes of a recording: processor time, bytes, and how near it is.
// In: a contender, a quantiser, a recording. Out: figures; the quantiser of a certain quality.
#pragma once

#include "screen/contenders.hpp"

namespace piblocks::benchmark {

struct Stream {
  double cpu_s = 0;                              ///< of encoding alone, all pictures
  int coarser_pictures = 0;                      ///< than the quantiser asks for
  std::vector<std::vector<std::uint8_t>> units;  ///< one a picture
};

struct Fidelity {
  double psnr_dB = 0;        ///< of all samples of all planes and pictures
  double least_psnr_dB = 0;  ///< of the worst picture
};

/// A quantiser, and what it gives.
struct Match {
  int qp = 0;
  Fidelity fidelity;
};

Stream encode(const Contender& contender, int qp, const Recording& recording);
std::size_t size_bytes(const Stream& stream);

/// Decodes with libavcodec. @throws Error if the stream does not have every picture.
Fidelity fidelity(const Stream& stream, const Recording& recording);

/// The quantiser whose PSNR is nearest to the wanted one, or near enough.
Match nearest_match(const Contender& contender, const Match& wanted, const Recording& recording);

}  // namespace piblocks::benchmark
