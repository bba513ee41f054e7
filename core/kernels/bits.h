// Sets of pixels as bits in words, the leftmost pixel in the lowest bit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mocap::kernels {

using BitWord = std::uint64_t;

/// Keeps the pixels of `to` that are also in `from`.
void KeepCommon(const BitWord* from, std::size_t count, BitWord* to);
/// Adds the pixels of `from` to `to`.
void AddAll(const BitWord* from, std::size_t count, BitWord* to);
/// Removes the pixels of `from` from `to`.
void RemoveAll(const BitWord* from, std::size_t count, BitWord* to);

/// Counts pixels.
std::int64_t CountBits(const BitWord* words, std::size_t count);

/// Rows are at most this many words long.
inline constexpr std::size_t kMostRowWords = 256;
/// Keeps the pixels of consecutive rows whose neighbours to the left and right are also set. Pixels
/// beyond the ends of a row count as set.
/// @param per_row  words per row; `count` is a multiple of it.
/// @param radius   number of neighbours on each side, 1 to 3.
void KeepCommonAlong(BitWord* words, std::size_t count, std::size_t per_row, int radius);
/// Adds the neighbours to the left and right, within rows.
void AddAllAlong(BitWord* words, std::size_t count, std::size_t per_row, int radius);

}  // namespace mocap::kernels
