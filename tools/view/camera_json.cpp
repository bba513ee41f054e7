#include "tools/view/camera_json.h"

#include "daemon/base/json.h"

namespace mocap {
namespace {

constexpr double kDepth_mm = 1000;

Json NumbersOf(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// Corners of the picture, projected to one metre from the camera.
Json CornersOf(const CameraCalibration& camera, const RigidTransform& X_WC) {
  const double right = camera.width_px - 1, bottom = camera.height_px - 1;
  Json corners = Json::array();
  for (const Vector2& pixel :
       {Vector2(0, 0), Vector2(right, 0), Vector2(right, bottom), Vector2(0, bottom)}) {
    const std::optional<Vector2> normalized = NormalizedFromPixel(camera.lens, pixel);
    const Vector3 ray =
        normalized ? Vector3(normalized->x(), normalized->y(), 1) : Vector3::UnitZ();
    corners.push_back(NumbersOf(X_WC * Vector3(ray * kDepth_mm)));
  }
  return corners;
}

Json CameraJson(const CameraCalibration& camera, const RigidTransform& X_CW) {
  const RigidTransform X_WC = X_CW.Inverse();
  Json rotation = Json::array();
  for (int i = 0; i < 9; ++i) rotation.push_back(X_CW.R(i / 3, i % 3));
  return {{"name", camera.name},
          {"size_px", {camera.width_px, camera.height_px}},
          {"position_mm", NumbersOf(X_WC.p)},
          {"rotation", rotation},
          {"corners_mm", CornersOf(camera, X_WC)}};
}

}  // namespace

std::string StudioJson(const std::string& name, std::span<const CameraCalibration> cameras,
                       std::span<const RigidTransform> X_CW) {
  Json json{{"type", "studio"}, {"name", name}, {"cameras", Json::array()}};
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    json["cameras"].push_back(CameraJson(cameras[i], X_CW[i]));
  }
  return JsonText(json);
}

}  // namespace mocap
