#include "config/room_limits.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/calibration/camera_places.h"
#include "core/errors.h"
#include "core/reconstruction/carving/volume_of_interest.h"

namespace mocap {
namespace {

/// Cameras that are closer together look from one place: their unit is metres.
constexpr double kNearest_mm = 100;
constexpr double kLargestRoom_mm = 200e3;
/// One bit each: a gigabyte.
constexpr double kMostVoxels = 8e9;

std::string Text(const char* format, double a, double b = 0, double c = 0) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), format, a, b, c);
  return text.data();
}

std::string RoomText(const Vector3& size_mm) {
  const Vector3 size_m = size_mm / 1000;
  return Text("%.4g x %.4g x %.4g m", size_m.x(), size_m.y(), size_m.z());
}

}  // namespace

void RequireRoom(std::span<const CameraCalibration> cameras, double voxel_mm,
                 const std::string& where) {
  Eigen::AlignedBox3d centers, room;
  for (const CameraCalibration& camera : cameras) {
    centers.extend(camera.X_CW.Inverse().p);
    room.extend(RoomBefore(camera.X_CW));
  }
  if (cameras.empty()) return;
  const double apart_mm = centers.diagonal().norm();
  if (cameras.size() > 1 && !(apart_mm >= kNearest_mm)) {
    throw SetupError(where + ": its cameras lie within " + Text("%.3g", apart_mm) +
                     " mm of each other; expected lengths in millimetres, not metres, and a "
                     "pose for each lens");
  }
  const Vector3 size_mm = room.diagonal();
  if (!(size_mm.maxCoeff() <= kLargestRoom_mm)) {
    throw SetupError(where + ": its cameras look at a room of " + RoomText(size_mm) +
                     "; expected at most " + Text("%g", kLargestRoom_mm / 1000) +
                     " m, from lengths in millimetres");
  }
  if (!(size_mm.minCoeff() > 0)) {
    throw SetupError(where +
                     ": its cameras look at nothing above the floor; expected the floor at z = 0 "
                     "and z up, as `mocap calibrate floor` sets them");
  }
  const double voxels = size_mm.prod() / std::pow(voxel_mm, 3);
  if (voxels <= kMostVoxels) return;
  throw SetupError(
      where + ": its cameras look at a room of " + RoomText(size_mm) + ", " +
      Text("%.2g voxels of %g mm", voxels, voxel_mm) + "; expected " +
      Text("voxels of %.0f mm or more", std::ceil(std::cbrt(size_mm.prod() / kMostVoxels))) +
      ", or a calibration in millimetres");
}

void RemarkOnPlaces(std::span<const CameraCalibration> cameras, const std::filesystem::path& file,
                    Studio& studio) {
  for (const Finding& finding : CheckPlaces(cameras, true)) {
    studio.remarks.push_back(file.string() + ": " + finding.text);
  }
}

}  // namespace mocap
