#include "tools/report/hull_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/errors.h"

namespace mocap {
namespace {

/// A voxel with neighbours on all sides is hidden.
bool IsOnSurface(const VoxelGrid& grid, int i, int j, int k) {
  const auto occupied = [&](int x, int y, int z) {
    return grid.Contains(x, y, z) && grid.Test(x, y, z);
  };
  return !(occupied(i - 1, j, k) && occupied(i + 1, j, k) && occupied(i, j - 1, k) &&
           occupied(i, j + 1, k) && occupied(i, j, k - 1) && occupied(i, j, k + 1));
}

/// Projected corners of a voxel; empty if the camera does not see all of them.
std::optional<std::array<cv::Point, 8>> ProjectCorners(const Vector3& low_W, double size_mm,
                                                       const CameraCalibration& camera,
                                                       const RigidTransform& X_CW) {
  std::array<cv::Point, 8> corners;
  for (int c = 0; c < 8; ++c) {
    const Vector3 p_C = X_CW * (low_W + size_mm * Vector3(c & 1, c >> 1 & 1, c >> 2));
    if (p_C.z() <= 0) return std::nullopt;
    const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
    // Far outside the picture, a corner would overflow OpenCV's fixed-point coordinates.
    if (!pixel || pixel->cwiseAbs().maxCoeff() > 1e4) return std::nullopt;
    corners[c] = {cvRound(pixel->x()), cvRound(pixel->y())};
  }
  return corners;
}

}  // namespace

Image<std::uint8_t> ProjectVoxels(const VoxelGrid& grid, const CameraCalibration& camera,
                                  const RigidTransform& X_CW) {
  Image<std::uint8_t> painted(camera.width_px, camera.height_px, 0);
  cv::Mat canvas(painted.height(), painted.width(), CV_8U, painted.row(0));
  std::vector<cv::Point> outline;
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      for (int i = 0; i < grid.size().x(); ++i) {
        if (!grid.Test(i, j, k) || !IsOnSurface(grid, i, j, k)) continue;
        const Vector3 low_W =
            (grid.first_voxel() + Eigen::Vector3i(i, j, k)).cast<double>() * grid.voxel_mm();
        const auto corners = ProjectCorners(low_W, grid.voxel_mm(), camera, X_CW);
        if (!corners) continue;
        cv::convexHull(*corners, outline);
        cv::fillConvexPoly(canvas, outline, cv::Scalar(255));
      }
    }
  }
  return painted;
}

double OverlapOf(const Image<std::uint8_t>& painted, const Silhouette& silhouette) {
  MOCAP_CHECK(painted.width() == silhouette.width() && painted.height() == silhouette.height());
  std::int64_t both = 0, either = 0;
  for (int y = 0; y < painted.height(); ++y) {
    for (int x = 0; x < painted.width(); ++x) {
      const bool in_painted = painted(x, y) != 0;
      const bool in_silhouette = silhouette.Test(x, y);
      both += in_painted && in_silhouette;
      either += in_painted || in_silhouette;
    }
  }
  return either == 0 ? 1 : static_cast<double>(both) / static_cast<double>(either);
}

int CameraOverlap::frames() const {
  return static_cast<int>(std::ranges::count_if(iou, [](double v) { return !std::isnan(v); }));
}

double CameraOverlap::mean() const {
  double sum = 0;
  for (const double value : iou) sum += std::isnan(value) ? 0 : value;
  return sum / std::max(1, frames());
}

double CameraOverlap::lowest() const {
  double lowest = 1;
  for (const double value : iou) lowest = std::isnan(value) ? lowest : std::min(lowest, value);
  return lowest;
}

}  // namespace mocap
