#include "core/reconstruction/carving/volume_of_interest.h"

#include <algorithm>

namespace mocap {
namespace {

// Errors of the calibration, and soles, stay within this distance below the floor.
constexpr double kBelowFloor_mm = 50;
// Greatest distance of a person in front of a camera, and the margin around that.
constexpr double kReach_mm = 6000;
constexpr double kMargin_mm = 1000;

Eigen::AlignedBox3d LookedAt(std::span<const CarvingView> views) {
  Eigen::AlignedBox3d room;
  for (const CarvingView& view : views) room.extend(RoomBefore(view.X_CW));
  return room;
}

void ClipToSilhouette(const CarvingView& view, const PixelBox& box, ConvexVolume& volume) {
  const SensorPlaneTable::Window window =
      view.table->WindowOf(box.left, box.top, box.right, box.bottom);
  const bool left_open = box.left == 0;
  const bool top_open = box.top == 0;
  const bool right_open = box.right == view.silhouette->width() - 1;
  const bool bottom_open = box.bottom == view.silhouette->height() - 1;
  // Keeps normal · p_C <= 0 in the camera's frame.
  const auto clip = [&](const Vector3& normal_C) {
    volume.Clip(view.X_CW.R.transpose() * normal_C, -normal_C.dot(view.X_CW.p));
  };
  clip({0, 0, -1});
  // If the person leaves the picture on one side, the part outside may extend beyond the
  // neighbouring sides too. So these sides bound nothing either.
  const bool sideways = left_open || right_open;
  const bool upright = top_open || bottom_open;
  if (!left_open && !upright) clip({-1, 0, window.low.x()});
  if (!right_open && !upright) clip({1, 0, -window.high.x()});
  if (!top_open && !sideways) clip({0, -1, window.low.y()});
  if (!bottom_open && !sideways) clip({0, 1, -window.high.y()});
}

}  // namespace

Eigen::AlignedBox3d RoomBefore(const RigidTransform& X_CW) {
  Eigen::AlignedBox3d room;
  room.extend(X_CW.Inverse().p);
  room.extend(X_CW.Inverse() * Vector3(0, 0, kReach_mm));
  const Vector3 margin = Vector3::Constant(kMargin_mm);
  room = Eigen::AlignedBox3d(room.min() - margin, room.max() + margin);
  room.min().z() = -kBelowFloor_mm;
  return room;
}

std::optional<Eigen::AlignedBox3d> VolumeOfInterest::Find(std::span<const CarvingView> views) {
  boxes_.clear();
  for (const CarvingView& view : views) boxes_.push_back(view.Box());
  if (views.empty()) return std::nullopt;
  volume_.Reset(LookedAt(views));
  const auto seeing = std::ranges::count_if(boxes_, [](const auto& box) { return !!box; });
  for (std::size_t i = 0; i < views.size(); ++i) {
    const bool is_final = views[i].outweighed_by >= seeing;
    if (boxes_[i] && is_final) ClipToSilhouette(views[i], *boxes_[i], volume_);
  }
  if (seeing < 2 || volume_.empty()) return std::nullopt;
  return volume_.Extent();
}

}  // namespace mocap
