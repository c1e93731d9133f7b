#include "h264/residual.hpp"

#include <span>

#include "h264/cavlc.hpp"

namespace piblocks::h264 {
namespace {

// coded_block_pattern of chroma, times 16 (7.4.5).
constexpr int kChromaDcOnly = 16;
constexpr int kChromaDcAndAc = 32;

/// A chroma block without its DC coefficient.
struct ChromaBlock {
  Block4x4 predicted;
  Coefficients coefficients{};
  std::int32_t dc = 0;
  int total = 0;  // TotalCoeff
};

ChromaBlock code_chroma_block(const Quantiser& quantiser, const Block4x4& source,
                              const Block4x4& predicted, Levels& levels) {
  ChromaBlock block{.predicted = predicted};
  levels = {};
  if (source == predicted) return block;
  block.coefficients = transform_difference(source, predicted);
  block.dc = block.coefficients[0][0];
  block.coefficients[0][0] = 0;
  block.total = quantiser.quantise(block.coefficients, levels);
  if (block.total == 0) block.coefficients = {};
  return block;
}

}  // namespace

void Residual::code_luma(const Quantiser& quantiser, BlockPlace place, const Samples& source,
                         Samples& samples) {
  const std::size_t number = place.number();
  const int offset = 4 * place.y * kLumaSide + 4 * place.x;
  std::uint8_t* const at = samples.plane(0) + offset;
  const Block4x4 wanted = load_block(source.plane(0) + offset, kLumaSide);
  const Block4x4 predicted = load_block(at, kLumaSide);
  total_coeff_[number] = 0;
  if (sum_of_differences(wanted, predicted) <= quantiser.negligible_sum()) return;
  Coefficients coefficients = transform_difference(wanted, predicted);
  const int total = quantiser.quantise(coefficients, levels_[number]);
  total_coeff_[number] = static_cast<std::uint8_t>(total);
  if (total > 0) store_block(add_inverse(coefficients, predicted), at, kLumaSide);
}

void Residual::code_chroma_plane(const Quantiser& quantiser, int plane, const Samples& source,
                                 Samples& samples) {
  const auto offset = [](int block) { return block / 2 * 4 * kChromaSide + block % 2 * 4; };
  const std::size_t first = BlockPlace{0, 0, plane}.number();
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filled below
  std::array<ChromaBlock, 4> blocks;
  std::array<std::int32_t, 4> dc{};
  for (int i = 0; i < 4; ++i) {
    blocks[i] = code_chroma_block(
        quantiser, load_block(source.plane(plane) + offset(i), kChromaSide),
        load_block(samples.plane(plane) + offset(i), kChromaSide), levels_[first + i]);
    dc[i] = blocks[i].dc;
    total_coeff_[first + i] = static_cast<std::uint8_t>(blocks[i].total);
  }
  dc_total_coeff_[plane - 1] = quantiser.quantise_chroma_dc(dc, dc_[plane - 1]);
  for (int i = 0; i < 4; ++i) {
    if (dc[i] == 0 && blocks[i].total == 0) continue;
    blocks[i].coefficients[0][0] = dc[i];
    store_block(add_inverse(blocks[i].coefficients, blocks[i].predicted),
                samples.plane(plane) + offset(i), kChromaSide);
  }
}

int Residual::coded_block_pattern() const {
  int pattern = 0;
  for (int index = 0; index < 16; ++index) {
    if (total_coeff_[luma_place(index).number()] != 0) pattern |= 1 << index / 4;
  }
  if (std::any_of(total_coeff_.begin() + 16, total_coeff_.end(), [](int n) { return n != 0; })) {
    return pattern | kChromaDcAndAc;
  }
  return dc_total_coeff_[0] + dc_total_coeff_[1] > 0 ? pattern | kChromaDcOnly : pattern;
}

bool Residual::write(int pattern, const MacroblockState& own, const Neighbours& neighbours,
                     std::size_t most_bits, BitWriter& bits) const {
  for (int index = 0; index < 16; ++index) {
    if ((pattern >> index / 4 & 1) == 0) continue;
    if (bits.bit_count() > most_bits) return false;
    const BlockPlace place = luma_place(index);
    const std::size_t i = place.number();
    if (!write_levels(levels_[i], total_coeff_[i], nc_of(own, neighbours, place), bits)) {
      return false;
    }
  }
  if (pattern < kChromaDcOnly) return true;
  for (int i = 0; i < 2; ++i) {
    if (!write_levels(dc_[i], dc_total_coeff_[i], kChromaDc, bits)) return false;
  }
  if (pattern < kChromaDcAndAc) return true;
  for (int block = 0; block < 8; ++block) {
    const BlockPlace place = {block % 2, block / 2 % 2, 1 + block / 4};
    const std::size_t i = place.number();
    const auto ac = std::span(levels_[i]).subspan(1);
    if (!write_levels(ac, total_coeff_[i], nc_of(own, neighbours, place), bits)) return false;
  }
  return true;
}

}  // namespace piblocks::h264
