#include "tools/calibration/studio_check.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "tools/calibration/lens_conversion.h"
#include "tools/calibration/lens_parameters.h"

namespace mocap {
namespace {

constexpr double kGood_px = 0.5, kPoor_px = 1.0;
constexpr double kUncertainFocal = 0.01;
// Many fits fold in the outermost corners.
constexpr double kMuchFolded = 0.05;
constexpr double kHip_mm = 1000;
constexpr double kRoom_mm = 8000, kReach_mm = 2200;

const CameraCalibration& CameraNamed(const std::string& name,
                                     const std::vector<CameraCalibration>& cameras) {
  const auto camera = std::find_if(cameras.begin(), cameras.end(),
                                   [&](const CameraCalibration& c) { return c.name == name; });
  if (camera == cameras.end()) {
    throw SetupError("--distance: there is no camera " + Quoted(name) + "; " +
                     ExpectedNames(name, CameraNames(cameras)));
  }
  return *camera;
}

void CheckLens(const CameraCalibration& camera, std::vector<Finding>& findings) {
  const auto warn = [&](const std::string& text) {
    findings.push_back({Severity::kWarning, camera.name + ": " + text});
  };
  const Vector2 size(camera.width_px, camera.height_px);
  const Vector2 off = CenterPx(camera.lens) - size / 2;
  if (std::abs(off.x()) > 0.15 * size.x() || std::abs(off.y()) > 0.15 * size.y())
    warn(
        fmt::format("its axis meets the picture {:.0f}, {:.0f} px off the middle; views that fill "
                    "the picture and more tilts determine it better",
                    off.x(), off.y()));
  if (const double folded = FoldedShare(camera); folded > kMuchFolded)
    warn(
        fmt::format("its lens folds inside the picture: {:.0f} % of it, at the rim, is not used; "
                    "calibrate it with views that fill the picture",
                    100 * folded));
  const double field_deg = 2 * std::atan(size.x() / 2 / FocalPx(camera.lens)) * kDegreesPerRad;
  if (field_deg < 10 || field_deg > 160)
    warn(
        fmt::format("has a field of view of {:.0f} degrees, as few lenses do; check the size of "
                    "the board's squares, and that the picture's size is that of the recording",
                    field_deg));
}

// A person carried the board, so it was hardly ever below the floor.
void CheckBoardsAboveFloor(const StudioFit& fit, std::vector<Finding>& findings) {
  int under = 0, all = 0;
  for (const auto& X_WB : fit.bundle.X_WB) {
    if (!X_WB) continue;
    ++all;
    const Vector3 middle =
        *X_WB * ((fit.detections.board.Corner(0) +
                  fit.detections.board.Corner(fit.detections.board.corners() - 1)) /
                 2);
    under += middle.z() < -50;
  }
  if (all > 0 && under > all / 5)
    findings.push_back(
        {Severity::kWrong,
         fmt::format("the board was below the floor in {} of {} moments: the floor is "
                     "upside down or not where the floor's board lay",
                     under, all)});
}

void CheckCamera(const CameraFit& camera, std::vector<Finding>& findings) {
  if (camera.rms_px > kPoor_px)
    findings.push_back(
        {Severity::kWarning,
         fmt::format("{}: {:.2f} px remain; below {} is good: hold the board flat and "
                     "still, light it, and check that the cameras run in step",
                     camera.name, camera.rms_px, kGood_px)});
  if (camera.focal_sigma_share > kUncertainFocal)
    findings.push_back(
        {Severity::kWarning,
         fmt::format("{}: its own views leave the focal length uncertain by {:.1f} %; "
                     "tilt the board by 30 degrees and more before it",
                     camera.name, 100 * camera.focal_sigma_share)});
  const std::string hint = camera.coverage.Hint();
  if (!hint.empty() && camera.coverage.share < 0.6)
    findings.push_back({Severity::kNote, camera.name + ": " + hint});
  if (camera.views < 10)
    findings.push_back(
        {Severity::kWarning, fmt::format("{}: only {} views of the board; 20 and more are good",
                                         camera.name, camera.views)});
}

}  // namespace

Vector3 MiddleOfRoom(const std::vector<CameraCalibration>& cameras) {
  Matrix3 A = 1e-6 * Matrix3::Identity();
  Vector3 b = Vector3::Zero();
  for (const CameraCalibration& camera : cameras) {
    const RigidTransform X_WC = camera.X_CW.Inverse();
    const Vector3 axis = X_WC.R.col(2);
    const Matrix3 across = Matrix3::Identity() - axis * axis.transpose();
    A += across;
    b += across * X_WC.p;
  }
  return A.inverse() * b;
}

double MillimetresPerPixel(const CameraCalibration& camera, const Vector3& middle_W) {
  return (middle_W - camera.X_CW.Inverse().p).norm() / FocalPx(camera.lens);
}

std::vector<Finding> CheckCameras(const std::vector<CameraCalibration>& cameras, bool has_floor) {
  std::vector<Finding> findings = CheckPlaces(cameras, has_floor);
  for (const CameraCalibration& camera : cameras) CheckLens(camera, findings);
  return findings;
}

std::vector<Finding> CheckFit(const StudioFit& fit) {
  std::vector<Finding> findings;
  if (fit.has_poses) findings = CheckPlaces(fit.bundle.cameras, fit.has_floor);
  for (const CameraCalibration& camera : fit.bundle.cameras) CheckLens(camera, findings);
  if (fit.has_floor && fit.bundle.X_WB.size() > 1) CheckBoardsAboveFloor(fit, findings);
  if (fit.has_poses && !fit.has_floor && fit.bundle.cameras.size() > 1)
    findings.push_back(
        {Severity::kWarning,
         "the floor is not set: the world is the first camera's; lay the board on the "
         "floor and run mocap calibrate floor"});
  if (fit.bundle.X_WB.size() > 1) {
    for (const CameraFit& camera : fit.cameras) CheckCamera(camera, findings);
  }
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return findings;
}

std::ptrdiff_t CountOf(Severity severity, const std::vector<Finding>& findings) {
  return std::ranges::count(findings, severity, &Finding::severity);
}

const char* NameOf(Severity severity) {
  if (severity == Severity::kWrong) return "error";
  return severity == Severity::kWarning ? "warning" : "note";
}

std::string Conclusion(const std::vector<Finding>& findings) {
  if (CountOf(Severity::kWrong, findings) > 0) return "Do not use this calibration.";
  if (CountOf(Severity::kWarning, findings) > 0)
    return "This calibration can be used, but check the warnings.";
  return "This calibration is good.";
}

KnownDistance ParseDistance(const std::string& text) {
  const std::size_t first = text.find(':'), second = text.rfind(':');
  KnownDistance distance;
  if (first != std::string::npos && first < second) {
    distance.from = text.substr(0, first);
    distance.to = text.substr(first + 1, second - first - 1);
    char* end = nullptr;
    distance.mm = std::strtod(text.c_str() + second + 1, &end);
    const bool is_length = std::isfinite(distance.mm) && distance.mm > 0;
    if (is_length && distance.mm < kNearestCameras_mm)
      throw SetupError(
          fmt::format("--distance {}: {:g} mm do not lie between two cameras; expected "
                      "millimetres",
                      Quoted(text), distance.mm));
    if (*end == '\0' && is_length && distance.from != distance.to) return distance;
  }
  throw SetupError("--distance " + Quoted(text) + ": expected CAMERA:CAMERA:MM");
}

double DistanceMm(const KnownDistance& distance, const std::vector<CameraCalibration>& cameras) {
  return (CameraNamed(distance.from, cameras).X_CW.Inverse().p -
          CameraNamed(distance.to, cameras).X_CW.Inverse().p)
      .norm();
}

SeenVolume MeasureSeenVolume(const std::vector<CameraCalibration>& cameras) {
  SeenVolume volume;
  Vector3 middle = MiddleOfRoom(cameras);
  volume.low_W = {middle.x() - kRoom_mm / 2, middle.y() - kRoom_mm / 2, 0};
  volume.high_W = {middle.x() + kRoom_mm / 2, middle.y() + kRoom_mm / 2, kReach_mm};
  volume.columns = volume.rows = static_cast<int>(kRoom_mm / volume.cell_mm);
  volume.plan.assign(static_cast<std::size_t>(volume.columns) * volume.rows, 0);
  volume.cubic_m.assign(cameras.size() + 1, 0);
  const double cell_m3 = std::pow(volume.cell_mm / 1000, 3);
  const int layers = static_cast<int>(kReach_mm / volume.cell_mm);
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < volume.rows; ++j) {
      for (int i = 0; i < volume.columns; ++i) {
        const Vector3 p_W = volume.low_W + volume.cell_mm * Vector3(i + 0.5, j + 0.5, k + 0.5);
        int seen = 0;
        for (const CameraCalibration& camera : cameras) {
          const Vector3 p_C = camera.X_CW * p_W;
          if (p_C.z() < 200) continue;
          const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
          seen += pixel && pixel->minCoeff() >= 0 && pixel->x() < camera.width_px &&
                  pixel->y() < camera.height_px;
        }
        for (int n = 0; n <= seen; ++n) volume.cubic_m[n] += cell_m3;
        if (k == static_cast<int>(kHip_mm / volume.cell_mm))
          volume.plan[static_cast<std::size_t>(j) * volume.columns + i] = seen;
      }
    }
  }
  return volume;
}

}  // namespace mocap
