#include "core/reconstruction/carving/watershed.h"

#include <algorithm>

namespace mocap {

void Watershed::Divide(std::span<const VoxelPieces::Run> runs, const VoxelGrid& grid,
                       const HillLimits& limits) {
  MeasureHeights(runs);
  Flood(grid, limits);
  numbers_.assign(hills_.size(), -1);
  count_ = 0;
  for (const int column : from_above_) {
    const int whole = WholeOf(hills_of_columns_[column]);
    if (numbers_[whole] < 0) numbers_[whole] = count_++;
    hills_of_columns_[column] = numbers_[whole];
  }
}

void Watershed::MeasureHeights(std::span<const VoxelPieces::Run> runs) {
  low_ = {runs.front().begin, runs.front().j};
  Eigen::Vector2i past = low_;
  for (const VoxelPieces::Run& run : runs) {
    low_ = low_.cwiseMin(Eigen::Vector2i(run.begin, run.j));
    past = past.cwiseMax(Eigen::Vector2i(run.end, run.j + 1));
  }
  size_ = past - low_;
  const auto columns = static_cast<std::size_t>(size_.x()) * size_.y();
  tops_.assign(columns, -1);
  voxels_.assign(columns, 0);
  hills_of_columns_.assign(columns, -1);
  for (const VoxelPieces::Run& run : runs) {
    for (int i = run.begin; i < run.end; ++i) {
      const std::size_t column = IndexOf(i, run.j);
      tops_[column] = std::max(tops_[column], run.k);
      ++voxels_[column];
    }
  }
  from_above_.clear();
  for (std::size_t column = 0; column < columns; ++column)
    if (voxels_[column] > 0) from_above_.push_back(static_cast<int>(column));
  std::ranges::stable_sort(from_above_, [&](int a, int b) { return tops_[a] > tops_[b]; });
}

int Watershed::WholeOf(int hill) const {
  while (hills_[hill].whole != hill) hill = hills_[hill].whole;
  return hill;
}

// Visits the hills of the columns beside one.
template <typename Visit>
void Watershed::ForEachBeside(int column, const Visit& visit) const {
  const int x = column % size_.x(), y = column / size_.x();
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, size_.y() - 1); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, size_.x() - 1); ++i) {
      const int beside = hills_of_columns_[static_cast<std::size_t>(j) * size_.x() + i];
      if (beside >= 0) visit(WholeOf(beside));
    }
  }
}

void Watershed::Flood(const VoxelGrid& grid, const HillLimits& limits) {
  const double voxel_mm = grid.voxel_mm();
  const int least_top = static_cast<int>(limits.top_mm / voxel_mm) - grid.first_voxel().z();
  const double least_voxels = limits.litres * 1e6 / (voxel_mm * voxel_mm * voxel_mm);
  hills_.clear();
  for (const int column : from_above_) {
    const auto is_separate = [&](const Hill& hill) {
      return (hill.top - tops_[column]) * voxel_mm >= limits.valley_mm && hill.top >= least_top &&
             hill.voxels >= least_voxels;
    };
    int highest = -1;
    ForEachBeside(column, [&](int hill) {
      if (hill == highest) return;
      if (highest >= 0 && hills_[hill].top > hills_[highest].top) std::swap(hill, highest);
      if (highest < 0) {
        highest = hill;
      } else if (!is_separate(hills_[hill]) || !is_separate(hills_[highest])) {
        hills_[highest].voxels += hills_[hill].voxels;
        hills_[hill].whole = highest;
      }
    });
    if (highest < 0) {
      highest = static_cast<int>(hills_.size());
      hills_.push_back({highest, tops_[column], 0});
    }
    hills_of_columns_[column] = highest;
    hills_[highest].voxels += voxels_[column];
  }
}

}  // namespace mocap
