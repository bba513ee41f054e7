#include "core/acquisition/feet.h"

#include <algorithm>
#include <tuple>

namespace mocap {
namespace {

// Feet are below the first height, and what is between the two heights is shin.
constexpr double kAnkleMm = 75;
constexpr double kShinMm = 175;
// A third of a foot; smaller pieces are scraps.
constexpr double kLeastFootLitres = 0.3;
// Feet are 30 to 50 mm before the shins. Less is noise: of a sole that leaves the floor, or of a
// foot under a gown.
constexpr double kLeastOffsetMm = 15;

bool IsBefore(const Eigen::Vector2i& a, const Eigen::Vector2i& b) {
  return std::tie(a.y(), a.x()) < std::tie(b.y(), b.x());
}

}  // namespace

void FeetFinder::CollectPiece(const VoxelCloud& cloud, int first) {
  const auto floor = static_cast<int>(is_taken_.size());
  piece_.assign(1, first);
  is_taken_[first] = 1;
  for (std::size_t next = 0; next < piece_.size(); ++next) {
    const Eigen::Vector3i cell = cloud.voxels()[piece_[next]].cell;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int beside = cloud.IndexAt(Eigen::Vector3i(cell + Eigen::Vector3i(dx, dy, dz)));
          if (beside < 0 || beside >= floor || is_taken_[beside]) continue;
          is_taken_[beside] = 1;
          piece_.push_back(beside);
        }
      }
    }
  }
  columns_.clear();
  for (const int i : piece_) columns_.emplace_back(cloud.voxels()[i].cell.head<2>());
  std::ranges::sort(columns_, IsBefore);
  columns_.erase(std::unique(columns_.begin(), columns_.end()), columns_.end());
}

std::optional<Vector3> FeetFinder::OffsetOfPiece(const VoxelCloud& cloud) {
  Vector3 foot_W = Vector3::Zero(), shin_W = Vector3::Zero();
  for (const int i : piece_) foot_W += cloud.voxels()[i].center_W;
  const Voxel& on_floor = cloud.voxels()[piece_.front()];
  const auto layers_above = [&](double height_mm) {
    return static_cast<int>((height_mm - on_floor.center_W.z()) / cloud.voxel_mm());
  };
  int count = 0;
  for (const Eigen::Vector2i& column : columns_) {
    for (int up = layers_above(kAnkleMm) + 1; up <= layers_above(kShinMm); ++up) {
      const int i = cloud.IndexAt(Eigen::Vector3i(column.x(), column.y(), on_floor.cell.z() + up));
      if (i < 0) continue;
      shin_W += cloud.voxels()[i].center_W;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  Vector3 offset_W = foot_W / static_cast<double>(piece_.size()) - shin_W / count;
  offset_W.z() = 0;
  return offset_W;
}

std::optional<Vector3> FeetFinder::ToesBeforeShins(const VoxelCloud& cloud) {
  // Voxels are listed from the floor up.
  const auto end = std::ranges::find_if(
      cloud.voxels(), [](const Voxel& voxel) { return voxel.center_W.z() >= kAnkleMm; });
  is_taken_.assign(static_cast<std::size_t>(end - cloud.voxels().begin()), 0);
  const double voxel_litres = cloud.voxel_mm() * cloud.voxel_mm() * cloud.voxel_mm() * 1e-6;
  Vector3 sum_W = Vector3::Zero();
  double voxels = 0;
  for (int i = 0; i < std::ssize(is_taken_); ++i) {
    if (is_taken_[i]) continue;
    CollectPiece(cloud, i);
    const auto size = static_cast<double>(piece_.size());
    if (size * voxel_litres < kLeastFootLitres) continue;
    const std::optional<Vector3> offset_W = OffsetOfPiece(cloud);
    if (!offset_W) continue;
    sum_W += size * *offset_W;
    voxels += size;
  }
  if (voxels == 0 || sum_W.norm() < kLeastOffsetMm * voxels) return std::nullopt;
  return Vector3(sum_W / voxels);
}

}  // namespace mocap
