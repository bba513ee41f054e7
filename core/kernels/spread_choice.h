// Chooses some of many places, evenly spread, by where they are. A chosen place stays chosen while
// others come and go: with every n-th of a list, still bodies trembled.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry.h"

namespace mocap {

/// Order in which places are chosen. Places that come early are spread evenly: the ranks are the
/// sequences R2 and R3 of Roberts ("The unreasonable effectiveness of quasirandom sequences",
/// 2018), read off at a place instead of an index.
using SpreadRank = std::uint32_t;

/// Rank of a pixel.
inline SpreadRank RankOfPixel(int x, int y) {
  return static_cast<SpreadRank>(x) * 3242174889u + static_cast<SpreadRank>(y) * 2447445414u;
}

/// Rank of a cell.
inline SpreadRank RankOfCell(const Eigen::Vector3i& cell) {
  return static_cast<SpreadRank>(cell.x()) * 3518319155u +
         static_cast<SpreadRank>(cell.y()) * 2882110345u +
         static_cast<SpreadRank>(cell.z()) * 2360945575u;
}

/// Finds the rank up to which places are chosen.
class SpreadChoice {
 public:
  /// Adds a place to choose from.
  void Add(SpreadRank rank) {
    ++counts_[rank / kWidth];
    ++all_;
  }
  /// Returns a limit: at most `most` of the added ranks are smaller, and hardly fewer.
  std::uint64_t LimitFor(std::size_t most) const {
    if (most >= all_) return kRanks;
    std::size_t below = 0, bin = 0;
    while ((below += counts_[bin]) <= most) ++bin;
    return bin * kWidth;
  }

 private:
  static constexpr std::uint64_t kRanks = std::uint64_t{1} << 32;
  static constexpr std::size_t kBins = 4096;
  static constexpr SpreadRank kWidth = kRanks / kBins;

  std::array<std::uint32_t, kBins> counts_{};
  std::size_t all_ = 0;
};

}  // namespace mocap
