#include "daemon/messages/look_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace mocap {
namespace {

/// Of the square's side to the larger side of the person's box.
constexpr double kMargin = 1.25;
/// Nearer than this, a person is before no lens.
constexpr double kNearest_mm = 200;
/// Largest side, as a multiple of the picture's larger one.
constexpr double kLargestSide = 1.5;

std::optional<Vector2> PixelOf(const Vector3& p_C, const Lens& lens) {
  if (p_C.z() < kNearest_mm) return {};
  return PixelFromNormalized(lens, p_C.head<2>() / p_C.z());
}

/// Around a ball: its extent across the line of sight, as if seen head-on.
void Extend(const Vector3& middle_C, double radius_mm, const Lens& lens, Eigen::AlignedBox2d& box) {
  for (const double side : {-1.0, 1.0}) {
    for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0)}) {
      if (const auto pixel = PixelOf(middle_C + side * radius_mm * axis, lens)) box.extend(*pixel);
    }
  }
}

/// @return  empty: the lens does not show the place.
std::optional<Vector2> UpAt(const Vector3& p_W, const Lens& lens, const RigidTransform& X_CW) {
  constexpr double kHandbreadth_mm = 100;
  const auto here = PixelOf(X_CW * p_W, lens);
  const auto above = PixelOf(X_CW * (p_W + kHandbreadth_mm * Vector3::UnitZ()), lens);
  if (!here || !above || (*above - *here).norm() == 0) return {};
  return (*above - *here).normalized();
}

}  // namespace

std::optional<LookRegion> RegionAround(std::span<const PosedCapsule> capsules,
                                       const CameraCalibration& camera,
                                       const RigidTransform& X_CW) {
  Eigen::AlignedBox2d box_px;
  Eigen::AlignedBox3d box_W;
  for (const PosedCapsule& capsule : capsules) {
    Extend(X_CW * capsule.a_W, capsule.radius_a_mm, camera.lens, box_px);
    Extend(X_CW * capsule.b_W, capsule.radius_b_mm, camera.lens, box_px);
    box_W.extend(capsule.a_W).extend(capsule.b_W);
  }
  const Eigen::AlignedBox2d picture_px(Vector2(-0.5, -0.5),
                                       Vector2(camera.width_px - 0.5, camera.height_px - 0.5));
  if (box_px.isEmpty() || !box_px.intersects(picture_px)) return {};
  const auto up = UpAt(box_W.center(), camera.lens, X_CW);
  if (!up) return {};
  const double wanted = kMargin * box_px.sizes().maxCoeff();
  const double most = kLargestSide * std::max(camera.width_px, camera.height_px);
  // Of somebody close to the camera, the part that is in the picture counts.
  const Vector2 middle =
      wanted <= most ? box_px.center() : box_px.intersection(picture_px).center();
  LookRegion region;
  region.side_px = static_cast<int>(std::ceil(std::clamp(wanted, 1.0, most)));
  region.left_px = static_cast<int>(std::lround(middle.x() - region.side_px / 2.0 + 0.5));
  region.top_px = static_cast<int>(std::lround(middle.y() - region.side_px / 2.0 + 0.5));
  region.up = *up;
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
