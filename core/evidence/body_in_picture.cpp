#include "core/evidence/body_in_picture.h"

namespace mocap {
namespace {

// Nearer to the lens, or behind it, nothing is seen.
constexpr double kNearest_mm = 100;

std::optional<Vector2> PixelOf(const CameraCalibration& camera, const Vector3& p_C) {
  if (p_C.z() < kNearest_mm) return std::nullopt;
  return PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
}

bool IsInPicture(const CameraCalibration& camera, const Vector2& px) {
  return px.x() >= 0 && px.y() >= 0 && px.x() <= camera.width_px - 1 &&
         px.y() <= camera.height_px - 1;
}

// A ball's extent across the line of sight, as if seen head-on.
void ExtendByBall(const CameraCalibration& camera, const Vector3& middle_C, double radius_mm,
                  Eigen::AlignedBox2d& box_px) {
  for (const double side : {-radius_mm, radius_mm})
    for (const Vector3 towards : {Vector3::UnitX(), Vector3::UnitY()})
      if (const auto px = PixelOf(camera, middle_C + side * towards)) box_px.extend(*px);
}

std::optional<Vector2> UpAt(const CameraCalibration& camera, const RigidTransform& X_CW,
                            const Vector3& p_W) {
  constexpr double kHandbreadth_mm = 100;
  const auto here = PixelOf(camera, X_CW * p_W);
  const auto above = PixelOf(camera, X_CW * (p_W + kHandbreadth_mm * Vector3::UnitZ()));
  if (!here || !above || *above == *here) return std::nullopt;
  return (*above - *here).normalized();
}

}  // namespace

std::optional<BodyInPicture> FindInPicture(std::span<const PosedCapsule> capsules,
                                           const CameraCalibration& camera,
                                           const RigidTransform& X_CW) {
  BodyInPicture seen;
  Eigen::AlignedBox3d body_W;
  std::size_t in_picture = 0;
  for (const PosedCapsule& capsule : capsules) {
    ExtendByBall(camera, X_CW * capsule.a_W, capsule.radius_a_mm, seen.box_px);
    ExtendByBall(camera, X_CW * capsule.b_W, capsule.radius_b_mm, seen.box_px);
    for (const Vector3& end_W : {capsule.a_W, capsule.b_W}) {
      body_W.extend(end_W);
      const auto px = PixelOf(camera, X_CW * end_W);
      in_picture += px && IsInPicture(camera, *px);
    }
  }
  if (seen.box_px.isEmpty()) return std::nullopt;
  seen.share = static_cast<double>(in_picture) / static_cast<double>(2 * capsules.size());
  seen.up = UpAt(camera, X_CW, body_W.center());
  return seen;
}

}  // namespace mocap
