#include "tools/import/silhouette_hull.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace mocap {
namespace {

/// The cleaned border of a silhouette may miss the picture's edge by this much.
constexpr int kEdge_px = 3;

struct BorderPoint {
  Vector2 normalized;
  bool is_at_edge = false;
};

struct RowEnds {
  int first, last;
};

std::optional<RowEnds> EndsOfRow(const Silhouette& silhouette, int y) {
  const std::uint64_t* row = silhouette.row(y);
  int first = 0, last = silhouette.words_per_row() - 1;
  while (first <= last && row[first] == 0) ++first;
  while (last > first && row[last] == 0) --last;
  if (first > last) return std::nullopt;
  return RowEnds{first * 64 + std::countr_zero(row[first]),
                 last * 64 + 63 - std::countl_zero(row[last])};
}

std::vector<BorderPoint> BorderOf(const Silhouette& silhouette, const Lens& lens) {
  std::vector<BorderPoint> border;
  const int width = silhouette.width(), height = silhouette.height();
  for (int y = 0; y < height; ++y) {
    const std::optional<RowEnds> ends = EndsOfRow(silhouette, y);
    if (!ends) continue;
    for (const int x : {ends->first, ends->last}) {
      const auto normalized = NormalizedFromPixel(lens, Vector2(x, y));
      const bool is_at_edge =
          x < kEdge_px || y < kEdge_px || x >= width - kEdge_px || y >= height - kEdge_px;
      if (normalized) border.push_back({*normalized, is_at_edge});
    }
  }
  return border;
}

std::vector<BorderPoint> ConvexHull(const std::vector<BorderPoint>& points) {
  std::vector<cv::Point2f> places;
  for (const BorderPoint& point : points)
    places.emplace_back(static_cast<float>(point.normalized.x()),
                        static_cast<float>(point.normalized.y()));
  std::vector<int> corners;
  if (!places.empty()) cv::convexHull(places, corners);
  std::vector<BorderPoint> hull;
  for (const int corner : corners) hull.push_back(points[static_cast<std::size_t>(corner)]);
  return hull;
}

}  // namespace

std::vector<HullCorner> HullOf(const Silhouette& silhouette, const CameraCalibration& camera) {
  std::vector<HullCorner> corners;
  const Matrix3 R_WC = camera.X_CW.R.transpose();
  for (const BorderPoint& point : ConvexHull(BorderOf(silhouette, camera.lens))) {
    const Vector3 ray_C(point.normalized.x(), point.normalized.y(), 1);
    corners.push_back({R_WC * ray_C.normalized(), point.is_at_edge});
  }
  return corners;
}

Silhouette LargestPart(const Silhouette& silhouette) {
  const int width = silhouette.width(), height = silhouette.height();
  cv::Mat pixels(height, width, CV_8U), labels, figures, centers;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) pixels.at<std::uint8_t>(y, x) = silhouette.Test(x, y);
  const int count = cv::connectedComponentsWithStats(pixels, labels, figures, centers);
  Silhouette part(width, height);
  int largest = 0;  // The background is 0.
  for (int i = 1; i < count; ++i) {
    const auto area_of = [&](int label) { return figures.at<int>(label, cv::CC_STAT_AREA); };
    if (largest == 0 || area_of(i) > area_of(largest)) largest = i;
  }
  for (int y = 0; largest > 0 && y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (labels.at<int>(y, x) == largest) part.Set(x, y);
  return part;
}

CameraHulls NoHulls(const CameraCalibration& camera) {
  CameraHulls hulls{camera.X_CW.Inverse().p, 0, camera.height_px, {}};
  const Vector2 middle(camera.width_px / 2, camera.height_px / 2);
  const auto a = NormalizedFromPixel(camera.lens, middle);
  const auto b = NormalizedFromPixel(camera.lens, middle + Vector2(0, 1));
  hulls.pixel_rad = a && b ? (*b - *a).norm() : 1e-3;
  return hulls;
}

}  // namespace mocap
