#include "core/calibration/camera_places.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

constexpr double kHighest_mm = 10000;
/// Cameras around a person stand farther apart. In inches or centimetres they would not.
constexpr double kSmallestStudio_mm = 800;

std::string Rounded(double value) { return std::to_string(std::lround(value)); }

Vector3 EyeOf(const CameraCalibration& camera) { return camera.X_CW.Inverse().p; }

void CheckRotation(const CameraCalibration& camera, std::vector<Finding>& findings) {
  const Matrix3& R = camera.X_CW.R;
  if ((R * R.transpose() - Matrix3::Identity()).norm() < 1e-3 && R.determinant() > 0) return;
  findings.push_back({Severity::kWrong, camera.name +
                                            ": its rotation is a reflection or not a rotation; a "
                                            "conversion has mirrored the calibration"});
}

bool HasNoPose(const CameraCalibration& camera) {
  return camera.X_CW.p.isZero(0) && camera.X_CW.R == Matrix3::Identity();
}

void CheckPoses(std::span<const CameraCalibration> cameras, std::vector<Finding>& findings) {
  std::vector<std::size_t> without;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    if (HasNoPose(cameras[c])) without.push_back(c);
  }
  if (without.empty()) return;
  findings.push_back({Severity::kWrong, NamesOf(without, cameras) +
                                            ": at the origin, looking straight up: intrinsics "
                                            "without a pose (mocap calibrate extrinsics), or the "
                                            "floor is not set (mocap calibrate floor)"});
}

void CheckHeight(const CameraCalibration& camera, std::vector<Finding>& findings) {
  const Vector3 p_WC = EyeOf(camera);
  if (p_WC.z() < 0) {
    findings.push_back({Severity::kWrong,
                        camera.name + ": hangs " + Rounded(-p_WC.z()) +
                            " mm below the floor; the floor may be upside down, or this camera's "
                            "pose mirrored"});
  } else if (p_WC.z() > kHighest_mm) {
    findings.push_back(
        {Severity::kWarning, camera.name + ": hangs " + Rounded(p_WC.z() / 1000) +
                                 " m high; check that the board's squares are given in mm"});
  }
}

void CheckHeights(std::span<const CameraCalibration> cameras, std::vector<Finding>& findings) {
  const auto is_under = [](const CameraCalibration& camera) { return EyeOf(camera).z() < 0; };
  if (!cameras.empty() && std::ranges::all_of(cameras, is_under)) {
    findings.push_back(
        {Severity::kWrong, "all cameras hang below the floor, " + cameras.front().name + " by " +
                               Rounded(-EyeOf(cameras.front()).z()) +
                               " mm: z points down; set the floor again (mocap calibrate floor)"});
    return;
  }
  CheckPoses(cameras, findings);
  for (const CameraCalibration& camera : cameras) CheckHeight(camera, findings);
}

void CheckDistances(std::span<const CameraCalibration> cameras, std::vector<Finding>& findings) {
  double widest_mm = 0;
  std::vector<Finding> near;
  for (std::size_t a = 0; a < cameras.size(); ++a) {
    for (std::size_t b = a + 1; b < cameras.size(); ++b) {
      const double apart_mm = (EyeOf(cameras[a]) - EyeOf(cameras[b])).norm();
      widest_mm = std::max(widest_mm, apart_mm);
      const bool are_posed = !HasNoPose(cameras[a]) || !HasNoPose(cameras[b]);
      if (apart_mm >= kNearestCameras_mm || !are_posed) continue;
      near.push_back({Severity::kWrong, cameras[a].name + " and " + cameras[b].name + ": stand " +
                                            Rounded(apart_mm) +
                                            " mm apart; check that the two recordings differ, and "
                                            "that lengths are in millimetres"});
    }
  }
  const bool are_all_near = near.size() > 1 && widest_mm < kNearestCameras_mm;
  if (!are_all_near) findings.insert(findings.end(), near.begin(), near.end());
  if (are_all_near || (widest_mm >= kNearestCameras_mm && widest_mm < kSmallestStudio_mm)) {
    findings.push_back({are_all_near ? Severity::kWrong : Severity::kWarning,
                        "all cameras stand within " + Rounded(widest_mm) +
                            " mm; expected lengths in millimetres, not in metres, inches or "
                            "centimetres"});
  }
}

}  // namespace

std::string NamesOf(const std::vector<std::size_t>& indices,
                    std::span<const CameraCalibration> cameras) {
  std::string names;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const bool is_last = i + 1 == indices.size();
    if (i > 0) names += is_last ? " and " : ", ";
    names += cameras[indices[i]].name;
  }
  return names;
}

std::vector<Finding> CheckPlaces(std::span<const CameraCalibration> cameras, bool has_floor) {
  std::vector<Finding> findings;
  for (const CameraCalibration& camera : cameras) CheckRotation(camera, findings);
  if (has_floor) CheckHeights(cameras, findings);
  CheckDistances(cameras, findings);
  std::ranges::stable_sort(findings, std::greater(), &Finding::severity);
  return findings;
}

}  // namespace mocap
