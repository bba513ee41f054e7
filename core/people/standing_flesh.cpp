#include "core/people/standing_flesh.h"

#include <algorithm>

namespace mocap {
namespace {

// Two heads are this much higher than what connects them: shoulders, or hands that meet. So are
// knees, but they are lower than the head of somebody who sits on the floor.
constexpr double kValleyMm = 180;
constexpr double kLeastHeadMm = 700;

}  // namespace

void StandingFlesh::Divide(std::span<const VoxelPieces::Run> runs, const VoxelGrid& grid,
                           double least_litres) {
  MeasureHeights(runs);
  Flood(grid, least_litres);
  people_.assign(summits_.size(), -1);
  count_ = 0;
  for (const int column : from_above_) {
    const int whole = WholeOf(owners_[column]);
    if (people_[whole] < 0) people_[whole] = count_++;
    owners_[column] = people_[whole];
  }
}

void StandingFlesh::MeasureHeights(std::span<const VoxelPieces::Run> runs) {
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
  owners_.assign(columns, -1);
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

int StandingFlesh::WholeOf(int summit) const {
  while (summits_[summit].whole != summit) summit = summits_[summit].whole;
  return summit;
}

// Visits the summits of the columns beside one.
template <typename Visit>
void StandingFlesh::ForEachBeside(int column, const Visit& visit) const {
  const int x = column % size_.x(), y = column / size_.x();
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, size_.y() - 1); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, size_.x() - 1); ++i) {
      const int beside = owners_[static_cast<std::size_t>(j) * size_.x() + i];
      if (beside >= 0) visit(WholeOf(beside));
    }
  }
}

void StandingFlesh::Flood(const VoxelGrid& grid, double least_litres) {
  const double voxel_mm = grid.voxel_mm();
  const int least_top = static_cast<int>(kLeastHeadMm / voxel_mm) - grid.first_voxel().z();
  const double least_voxels = least_litres * 1e6 / (voxel_mm * voxel_mm * voxel_mm);
  summits_.clear();
  for (const int column : from_above_) {
    const auto is_person = [&](const Summit& summit) {
      return (summit.top - tops_[column]) * voxel_mm >= kValleyMm && summit.top >= least_top &&
             summit.voxels >= least_voxels;
    };
    int highest = -1;
    ForEachBeside(column, [&](int summit) {
      if (summit == highest) return;
      if (highest >= 0 && summits_[summit].top > summits_[highest].top) std::swap(summit, highest);
      if (highest < 0) {
        highest = summit;
      } else if (!is_person(summits_[summit]) || !is_person(summits_[highest])) {
        summits_[highest].voxels += summits_[summit].voxels;
        summits_[summit].whole = highest;
      }
    });
    if (highest < 0) {
      highest = static_cast<int>(summits_.size());
      summits_.push_back({highest, tops_[column], 0});
    }
    owners_[column] = highest;
    summits_[highest].voxels += voxels_[column];
  }
}

}  // namespace mocap
