#include "daemon/messages/look_region.h"

#include <algorithm>
#include <cmath>

#include "core/evidence/body_in_picture.h"

namespace mocap {
namespace {

/// Of the square's side to the larger side of the person's box.
constexpr double kMargin = 1.25;
/// Largest side, as a multiple of the picture's larger one.
constexpr double kLargestSide = 1.5;

}  // namespace

std::optional<LookRegion> RegionAround(std::span<const PosedCapsule> capsules,
                                       const CameraCalibration& camera,
                                       const RigidTransform& X_CW) {
  const auto seen = FindInPicture(capsules, camera, X_CW);
  const Eigen::AlignedBox2d picture_px(Vector2(-0.5, -0.5),
                                       Vector2(camera.width_px - 0.5, camera.height_px - 0.5));
  if (!seen || !seen->up || !seen->box_px.intersects(picture_px)) return {};
  const Eigen::AlignedBox2d& box_px = seen->box_px;
  const double wanted = kMargin * box_px.sizes().maxCoeff();
  const double most = kLargestSide * std::max(camera.width_px, camera.height_px);
  // Of somebody close to the camera, the part that is in the picture counts.
  const Vector2 middle =
      wanted <= most ? box_px.center() : box_px.intersection(picture_px).center();
  LookRegion region;
  region.side_px = static_cast<int>(std::ceil(std::clamp(wanted, 1.0, most)));
  region.left_px = static_cast<int>(std::lround(middle.x() - region.side_px / 2.0 + 0.5));
  region.top_px = static_cast<int>(std::lround(middle.y() - region.side_px / 2.0 + 0.5));
  region.up = *seen->up;
  return region;
}

void CutRegion(ImageView<const Bgr> picture, const LookRegion& region, Image<Bgr>& cut) {
  if (cut.width() != region.side_px || cut.height() != region.side_px)
    cut = Image<Bgr>(region.side_px, region.side_px);
  std::ranges::fill(cut.pixels(), Bgr{});
  const int left = std::max(0, region.left_px);
  const int right = std::min(picture.width(), region.left_px + region.side_px);
  const int top = std::max(0, region.top_px);
  const int bottom = std::min(picture.height(), region.top_px + region.side_px);
  for (int y = top; left < right && y < bottom; ++y)
    std::copy(picture.row(y) + left, picture.row(y) + right,
              cut.row(y - region.top_px) + left - region.left_px);
}

}  // namespace mocap
