#include "tools/report/calibration_figures.h"

#include <algorithm>
#include <cmath>

#include "tools/calibration/lens_parameters.h"

namespace mocap {
namespace {

constexpr double kErrorScale = 40;
constexpr double kConeMm = 1500;
constexpr int kConeFigure = 3;

Json Metres(double mm) { return NumberOrNull(mm / 1000); }

/// A camera's field of view from above, as a triangle.
Json ConeOf(const CameraCalibration& camera) {
  const RigidTransform X_WC = camera.X_CW.Inverse();
  const double half = camera.width_px / 2.0 / FocalPx(camera.lens);
  Json x = {Metres(X_WC.p.x())}, y = {Metres(X_WC.p.y())};
  for (const double side : {-half, half}) {
    const Vector3 ray = X_WC.R * Vector3(side, 0, 1);
    const Vector3 end = X_WC.p + ray * (kConeMm / std::max(1e-6, ray.head<2>().norm()));
    x.push_back(Metres(end.x()));
    y.push_back(Metres(end.y()));
  }
  return Series("", kConeFigure, "area", y, {{"x", x}});
}

}  // namespace

Json CoverageFigure(const StudioFit& fit, int camera, const std::vector<CornerError>& errors,
                    const std::string& hint) {
  const DetectionCamera& size = fit.detections.cameras[camera];
  const Coverage& coverage = fit.cameras[camera].coverage;
  int most = 1;
  for (const auto& row : coverage.counts) most = std::max(most, *std::max_element(row, row + 6));
  Json cells = Json::array(), x = Json::array(), y = Json::array();
  for (const auto& row : coverage.counts) {
    for (const int count : row) {
      cells.push_back(
          count == 0 ? Json(0)
                     : NumberOrNull(0.08 + 0.35 * std::sqrt(static_cast<double>(count) / most)));
    }
  }
  for (const CornerError& error : errors) {
    if (fit.detections.detections[error.detection].camera != camera) continue;
    const Vector2 end = error.pixel + kErrorScale * error.error_px;
    if (!end.allFinite()) continue;
    for (const double value : {error.pixel.x(), end.x(), 0.0}) x.push_back(std::round(value));
    for (const double value : {error.pixel.y(), end.y()}) y.push_back(std::round(value));
    y.push_back(nullptr);
  }
  return Figure(fit.cameras[camera].name, hint,
                Json::array({{{"x", {{"label", "x [px]"}, {"range", {0, size.width_px}}}},
                              {"y", {{"label", "y [px]"}, {"range", {size.height_px, 0}}}},
                              {"equal", true},
                              {"cells",
                               {{"low", {0, 0}},
                                {"size",
                                 {static_cast<double>(size.width_px) / Coverage::kColumns,
                                  static_cast<double>(size.height_px) / Coverage::kRows}},
                                {"columns", Coverage::kColumns},
                                {"values", cells}}},
                              {"series", Json::array({Series("", 1, "line", y, {{"x", x}})})}}}));
}

Json RoomPlan(const std::vector<CameraCalibration>& cameras, const SeenVolume& volume) {
  Json cells = Json::array(), series = Json::array();
  Json x = Json::array(), y = Json::array(), names = Json::array();
  for (const int seen : volume.plan)
    cells.push_back(seen < 2 ? Json(0)
                             : NumberOrNull(0.6 * seen / static_cast<double>(cameras.size())));
  for (const CameraCalibration& camera : cameras) {
    const Vector3 p_WC = camera.X_CW.Inverse().p;
    series.push_back(ConeOf(camera));
    x.push_back(Metres(p_WC.x()));
    y.push_back(Metres(p_WC.y()));
    names.push_back(camera.name);
  }
  series.push_back(Series("", 1, "dots", y, {{"x", x}, {"names", names}}));
  const double cell_m = volume.cell_mm / 1000;
  return Figure("",
                "How many cameras see each place at 1 m height: the darker, the more. x to the "
                "right, y up.",
                Json::array({{{"x", {{"label", "world x [m]"}}},
                              {"y", {{"label", "world y [m]"}}},
                              {"equal", true},
                              {"cells",
                               {{"low", {Metres(volume.low_W.x()), Metres(volume.low_W.y())}},
                                {"size", {cell_m, cell_m}},
                                {"columns", volume.columns},
                                {"values", cells}}},
                              {"series", series}}}));
}

}  // namespace mocap
