#include "tools/calibration/placement.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "drivers/quoted.h"
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
      throw SetupError("calibration: has no camera " + Quoted(wanted.name) +
                       ", which the other calibration has; expected the same cameras in both");
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

void AddDifferences(const std::vector<CameraCalibration>& cameras,
                    const std::vector<CameraCalibration>& reference, const Vector3& middle_W,
                    PlacementDifference& difference) {
  for (int i = 0; i < kAcross * kAcross * kLayers; ++i) {
    const int column = i % kAcross - kAcross / 2, row = i / kAcross % kAcross - kAcross / 2;
    const Vector3 p_W(middle_W.x() + kSpacing_mm * column, middle_W.y() + kSpacing_mm * row,
                      kLowest_mm + kLayer_mm * (i / (kAcross * kAcross)));
    std::vector<std::pair<const CameraCalibration*, Vector2>> seen;
    for (std::size_t c = 0; c < reference.size(); ++c) {
      if (const auto pixel = PixelOf(reference[c], p_W)) seen.emplace_back(&cameras[c], *pixel);
    }
    if (seen.size() < 2) continue;
    const double apart_mm = (Triangulate(seen) - p_W).norm();
    difference.mean_mm += (apart_mm - difference.mean_mm) / ++difference.points;
    if (apart_mm <= difference.worst_mm) continue;
    difference.worst_mm = apart_mm;
    difference.worst_at_W = p_W;
  }
}

}  // namespace

PlacementDifference ComparePlacement(const std::vector<CameraCalibration>& cameras,
                                     const std::vector<CameraCalibration>& reference) {
  const std::vector<CameraCalibration> matching = Matching(cameras, reference);
  const Vector3 middle_W = MiddleOfRoom(reference);
  PlacementDifference difference;
  AddDifferences(matching, reference, middle_W, difference);
  if (std::ranges::none_of(reference,
                           [](const CameraCalibration& c) { return c.head.has_value(); }))
    return difference;
  for (const PanTiltAngles& angles : {PanTiltAngles{kPan_rad, 0}, PanTiltAngles{-kPan_rad, 0},
                                      PanTiltAngles{0, kTilt_rad}, PanTiltAngles{0, -kTilt_rad}})
    AddDifferences(Turned(matching, angles), Turned(reference, angles), middle_W, difference);
  return difference;
}

}  // namespace mocap
