#include "h264/residual.hpp"

#include <algorithm>
#include <span>

#include "h264/cavlc.hpp"

namespace piblocks::h264 {
namespace {

constexpr int kHasChromaDc = 16;
constexpr int kHasChromaAc = 32;

/// The AC levels: all but the first.
std::span<const std::int16_t> ac(const Levels& levels) { return std::span(levels).subspan(1); }

/// The transform of a square of chroma, but for the DC coefficient.
struct ChromaSquare {
  Square predicted;
  Coefficients coefficients;
  std::int32_t dc;
  int total;  // of its levels
};

ChromaSquare code_chroma_square(const Quantiser& quantiser, const Square& source,
                                const Square& predicted, Levels& levels) {
  ChromaSquare square{predicted, {}, 0, 0};
  levels = {};
  if (source == predicted) return square;
  square.coefficients = transform_difference(source, predicted);
  square.dc = square.coefficients[0][0];
  square.coefficients[0][0] = 0;
  square.total = quantiser.quantise(square.coefficients, levels);
  if (square.total == 0) square.coefficients = {};
  return square;
}

void code_chroma_plane(const Quantiser& quantiser, int plane, const Samples& source,
                       Samples& samples, Residual& residual) {
  const auto offset = [](int block) { return block / 2 * 4 * kChromaSide + block % 2 * 4; };
  const int first = 4 * (plane - 1);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filled below
  std::array<ChromaSquare, 4> squares;
  std::array<std::int32_t, 4> dc{};
  for (int i = 0; i < 4; ++i) {
    squares[i] = code_chroma_square(
        quantiser, load_square(source.plane(plane) + offset(i), kChromaSide),
        load_square(samples.plane(plane) + offset(i), kChromaSide), residual.chroma_ac[first + i]);
    dc[i] = squares[i].dc;
    residual.totals[16 + first + i] = static_cast<std::uint8_t>(squares[i].total);
  }
  residual.dc_totals[plane - 1] = quantiser.quantise_chroma_dc(dc, residual.chroma_dc[plane - 1]);
  for (int i = 0; i < 4; ++i) {
    if (dc[i] == 0 && squares[i].total == 0) continue;
    squares[i].coefficients[0][0] = dc[i];
    store_square(add_inverse(squares[i].coefficients, squares[i].predicted),
                 samples.plane(plane) + offset(i), kChromaSide);
  }
}

bool write_luma(const Residual& residual, int cbp, const MacroblockState& own,
                const Neighbours& beside, BitWriter& bits) {
  for (int block = 0; block < 16; ++block) {
    if ((cbp >> block / 4 & 1) == 0) continue;
    const auto [x, y] = luma_place(block);
    const int nc = nc_of(own, beside, kBlockGrids[0], x, y);
    if (!write_levels(residual.luma[4 * y + x], own.totals[4 * y + x], nc, bits)) return false;
  }
  return true;
}

bool write_chroma_ac(const Residual& residual, const MacroblockState& own, const Neighbours& beside,
                     BitWriter& bits) {
  for (int block = 0; block < 8; ++block) {
    const BlockGrid& grid = kBlockGrids[1 + block / 4];
    const int nc = nc_of(own, beside, grid, block % 2, block / 2 % 2);
    if (!write_levels(ac(residual.chroma_ac[block]), own.totals[16 + block], nc, bits)) {
      return false;
    }
  }
  return true;
}

}  // namespace

void code_luma_block(const Quantiser& quantiser, BlockPlace place, const Samples& source,
                     Samples& samples, Residual& residual) {
  const int number = 4 * place.y + place.x;
  const int offset = 4 * place.y * kLumaSide + 4 * place.x;
  std::uint8_t* const at = samples.plane(0) + offset;
  const Square wanted = load_square(source.plane(0) + offset, kLumaSide);
  const Square predicted = load_square(at, kLumaSide);
  residual.totals[number] = 0;
  if (sum_of_differences(wanted, predicted) <= quantiser.negligible_sum()) return;
  Coefficients coefficients = transform_difference(wanted, predicted);
  const int total = quantiser.quantise(coefficients, residual.luma[number]);
  residual.totals[number] = static_cast<std::uint8_t>(total);
  if (total > 0) store_square(add_inverse(coefficients, predicted), at, kLumaSide);
}

void code_chroma(const Quantiser& quantiser, const Samples& source, Samples& samples,
                 Residual& residual) {
  for (int plane = 1; plane < 3; ++plane) {
    code_chroma_plane(quantiser, plane, source, samples, residual);
  }
}

int cbp_of(const Residual& residual) {
  const auto& totals = residual.totals;
  int cbp = 0;
  for (int block = 0; block < 16; ++block) {
    const auto [x, y] = luma_place(block);
    if (totals[4 * y + x] != 0) cbp |= 1 << block / 4;
  }
  if (std::any_of(totals.begin() + 16, totals.end(), [](int total) { return total != 0; })) {
    return cbp | kHasChromaAc;
  }
  return residual.dc_totals[0] + residual.dc_totals[1] > 0 ? cbp | kHasChromaDc : cbp;
}

bool write_residual(const Residual& residual, int cbp, const MacroblockState& own,
                    const Neighbours& beside, BitWriter& bits) {
  if (!write_luma(residual, cbp, own, beside, bits)) return false;
  if (cbp < kHasChromaDc) return true;
  for (int i = 0; i < 2; ++i) {
    if (!write_levels(residual.chroma_dc[i], residual.dc_totals[i], kChromaDc, bits)) return false;
  }
  return cbp < kHasChromaAc || write_chroma_ac(residual, own, beside, bits);
}

}  // namespace piblocks::h264
