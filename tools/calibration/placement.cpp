#include "tools/calibration/placement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "tools/calibration/floor.h"
#include "tools/calibration/studio_check.h"

namespace mocap {
namespace {

constexpr int kAcross = 5, kLayers = 4;
constexpr double kPan_rad = 0.3, kTilt_rad = 0.2;
constexpr double kSpacing_mm = 750, kLowest_mm = 100, kLayer_mm = 550;

// The camera of the same name for each camera of the reference.
std::vector<CameraCalibration> Matching(const std::vector<CameraCalibration>& cameras,
                                        const std::vector<CameraCalibration>& reference) {
  std::vector<CameraCalibration> matching;
  for (const CameraCalibration& wanted : reference) {
    const auto found = std::ranges::find(cameras, wanted.name, &CameraCalibration::name);
    if (found == cameras.end())
      throw SetupError(
          "calibration: has no camera " + Quoted(wanted.name) +
          ", which the other calibration has; " +
          WithNearestName(wanted.name, CameraNames(cameras), "expected the same cameras in both"));
    matching.push_back(*found);
  }
  return matching;
}

// Each camera, with its head at these angles.
std::vector<CameraCalibration> Turned(std::vector<CameraCalibration> cameras,
                                      const PanTiltAngles& angles) {
  for (CameraCalibration& camera : cameras) camera.X_CW = camera.PoseAt(angles);
  return cameras;
}

std::optional<Vector2> PixelOf(const CameraCalibration& camera, const Vector3& p_W) {
  const Vector3 p_C = camera.X_CW * p_W;
  if (p_C.z() <= 0) return {};
  const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
  if (!pixel || pixel->minCoeff() < 0 || pixel->x() >= camera.width_px ||
      pixel->y() >= camera.height_px)
    return {};
  return pixel;
}

/// One point by the reference, and by the calibration that is compared.
struct PlacedPoint {
  Vector3 reference_W, compared_W;
};

void AddPoints(const std::vector<CameraCalibration>& cameras,
               const std::vector<CameraCalibration>& reference, const Vector3& middle_W,
               std::vector<PlacedPoint>& points) {
  for (int i = 0; i < kAcross * kAcross * kLayers; ++i) {
    const int column = i % kAcross - kAcross / 2, row = i / kAcross % kAcross - kAcross / 2;
    const Vector3 p_W(middle_W.x() + kSpacing_mm * column, middle_W.y() + kSpacing_mm * row,
                      kLowest_mm + kLayer_mm * (i / (kAcross * kAcross)));
    std::vector<std::pair<const CameraCalibration*, Vector2>> seen;
    for (std::size_t c = 0; c < reference.size(); ++c) {
      if (const auto pixel = PixelOf(reference[c], p_W)) seen.emplace_back(&cameras[c], *pixel);
    }
    if (seen.size() >= 2) points.push_back({p_W, Triangulate(seen)});
  }
}

// Umeyama, PAMI 1991, without scale.
RigidTransform MotionOf(const std::vector<PlacedPoint>& points) {
  Eigen::Matrix3Xd from(3, points.size()), to(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = points[i].reference_W;
    to.col(static_cast<Eigen::Index>(i)) = points[i].compared_W;
  }
  const Eigen::Matrix4d X = Eigen::umeyama(from, to, false);
  return {X.topLeftCorner<3, 3>(), X.topRightCorner<3, 1>()};
}

PlacementDifference DifferenceOf(const std::vector<PlacedPoint>& points) {
  PlacementDifference difference;
  difference.points = static_cast<int>(points.size());
  if (points.size() < 3) return difference;
  difference.moved = MotionOf(points);
  const double share = 1.0 / static_cast<double>(points.size());
  for (const PlacedPoint& point : points) {
    const double apart_mm = (point.compared_W - point.reference_W).norm();
    difference.mean_mm += share * apart_mm;
    difference.left_mm += share * (point.compared_W - difference.moved * point.reference_W).norm();
    if (apart_mm <= difference.worst_mm) continue;
    difference.worst_mm = apart_mm;
    difference.worst_at_W = point.reference_W;
  }
  return difference;
}

}  // namespace

PlacementDifference ComparePlacement(const std::vector<CameraCalibration>& cameras,
                                     const std::vector<CameraCalibration>& reference) {
  const std::vector<CameraCalibration> matching = Matching(cameras, reference);
  const Vector3 middle_W = MiddleOfRoom(reference);
  std::vector<PlacedPoint> points;
  AddPoints(matching, reference, middle_W, points);
  if (std::ranges::any_of(reference,
                          [](const CameraCalibration& c) { return c.head.has_value(); })) {
    for (const PanTiltAngles& angles : {PanTiltAngles{kPan_rad, 0}, PanTiltAngles{-kPan_rad, 0},
                                        PanTiltAngles{0, kTilt_rad}, PanTiltAngles{0, -kTilt_rad}})
      AddPoints(Turned(matching, angles), Turned(reference, angles), middle_W, points);
  }
  return DifferenceOf(points);
}

}  // namespace mocap
