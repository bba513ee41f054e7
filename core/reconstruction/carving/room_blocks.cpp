#include "core/reconstruction/carving/room_blocks.h"

#include <algorithm>

namespace mocap {
namespace {

// The room is first searched in cubes of this many voxels.
constexpr int kLargestCube_voxels = 4 * RoomBlocks::kBlock_voxels;

}  // namespace

RoomBlocks::Plane RoomBlocks::PlaneOf(const RigidTransform& X_CW, const Vector3& normal_C) {
  const Vector3 n_W = X_CW.R.transpose() * normal_C;
  return {n_W, normal_C.dot(X_CW.p), n_W.lpNorm<1>()};
}

RoomBlocks::Cone RoomBlocks::ConeOf(const RigidTransform& X_CW,
                                    const SensorPlaneTable::Window& window) {
  return {PlaneOf(X_CW, {1, 0, -window.low.x()}), PlaneOf(X_CW, {-1, 0, window.high.x()}),
          PlaneOf(X_CW, {0, 1, -window.low.y()}), PlaneOf(X_CW, {0, -1, window.high.y()})};
}

void RoomBlocks::Find(std::span<const CarvingView> views, int fewest, double voxel_mm,
                      const Eigen::AlignedBox3d& within) {
  SetEyes(views);
  blocks_.clear();
  fewest_ = fewest;
  voxel_mm_ = voxel_mm;
  if (static_cast<int>(eyes_.size()) < fewest) return;
  Eigen::AlignedBox3d room = within;
  if (room.isEmpty()) {
    for (const CarvingView& view : views) room.extend(RoomBefore(view.X_CW));
  }
  room_first_ = (room.min() / voxel_mm).array().floor().cast<int>();
  room_size_ = (room.max() / voxel_mm).array().ceil().cast<int>() - room_first_.array();
  for (int k = 0; k < room_size_.z(); k += kLargestCube_voxels)
    for (int j = 0; j < room_size_.y(); j += kLargestCube_voxels)
      for (int i = 0; i < room_size_.x(); i += kLargestCube_voxels)
        Visit({i, j, k}, kLargestCube_voxels);
  FitGrid();
}

void RoomBlocks::SetEyes(std::span<const CarvingView> views) {
  eyes_.clear();
  for (const CarvingView& view : views) {
    const std::optional<PixelBox> box = view.Box();
    if (!box) continue;
    const RigidTransform& X_CW = view.X_CW;
    const SensorPlaneTable& table = *view.table;
    eyes_.push_back(
        {.ahead = PlaneOf(X_CW, {0, 0, 1}),
         .picture = ConeOf(X_CW, table.WindowOf(0, 0, table.width_px() - 1, table.height_px() - 1)),
         .all_picture = ConeOf(X_CW, table.InnerWindow()),
         .box = ConeOf(X_CW, table.WindowOf(box->left, box->top, box->right, box->bottom)),
         .outweighed_by = view.outweighed_by});
  }
}

void RoomBlocks::Visit(const Eigen::Vector3i& first, int side) {
  if ((first.array() >= room_size_.array()).any()) return;
  const double half_mm = side * voxel_mm_ / 2;
  const Vector3 middle_W =
      (room_first_ + first).cast<double>() * voxel_mm_ + Vector3::Constant(half_mm);
  if (!MayHoldFlesh(middle_W, half_mm)) return;
  if (side == kBlock_voxels) {
    blocks_.push_back(first);
    return;
  }
  for (int octant = 0; octant < 8; ++octant)
    Visit(first + side / 2 * Eigen::Vector3i(octant & 1, octant >> 1 & 1, octant >> 2), side / 2);
}

bool RoomBlocks::MayHoldFlesh(const Vector3& middle_W, double half_mm) const {
  const auto reaches_inside = [&](const Plane& plane) {
    return plane.n_W.dot(middle_W) + plane.d + half_mm * plane.reach >= 0;
  };
  const auto is_inside = [&](const Plane& plane) {
    return plane.n_W.dot(middle_W) + plane.d - half_mm * plane.reach >= 0;
  };
  int seeing = 0, outweighing = 0;
  for (const Eye& eye : eyes_) {
    const bool is_seen =
        reaches_inside(eye.ahead) && std::ranges::all_of(eye.picture, reaches_inside);
    if (!is_seen) continue;
    if (std::ranges::all_of(eye.box, reaches_inside)) {
      ++seeing;
      continue;
    }
    const bool is_empty = is_inside(eye.ahead) && std::ranges::all_of(eye.all_picture, is_inside);
    if (!is_empty) continue;
    outweighing += eye.outweighed_by;
    if (outweighing >= static_cast<int>(eyes_.size())) return false;
  }
  return seeing >= std::max(fewest_, outweighing);
}

void RoomBlocks::FitGrid() {
  Eigen::AlignedBox3i cells;
  for (const Eigen::Vector3i& block : blocks_) {
    cells.extend(block);
    cells.extend(Eigen::Vector3i(block.array() + kBlock_voxels));
  }
  if (blocks_.empty()) return;
  for (Eigen::Vector3i& block : blocks_) block -= cells.min();
  first_voxel_ = room_first_ + cells.min();
  size_voxels_ = cells.max().cwiseMin(room_size_) - cells.min();
}

}  // namespace mocap
