#include "core/reconstruction/carving/hull_agreement.h"

#include <algorithm>
#include <cmath>

#include "core/reconstruction/carving/other_views.h"

namespace mocap {
namespace {

constexpr double kVoxel_mm = 20;
/// The hull of fewer other cameras is too large to be useful.
constexpr std::size_t kFewestOthers = 2;
/// With less overlap, they do not see the same object.
constexpr double kLeastOverlap = 0.5;
/// Averaged over directions, a cube's outline has 1.5 times the area of its face.
const double kHalfOutline = std::sqrt(1.5) / 2;

template <typename Visit>
void ForEachVoxel(const VoxelGrid& grid, Visit visit) {
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      for (int i = 0; i < grid.size().x(); ++i) {
        if (grid.Test(i, j, k)) visit(i, j, k);
      }
    }
  }
}

/// Sets the square of pixels around a point, clipped to the picture.
void PaintSquare(const SensorPlaneTable::Place& center, double half_px, Silhouette& painted) {
  const int left = std::max(0, static_cast<int>(std::ceil(center.x_px - half_px)));
  const int top = std::max(0, static_cast<int>(std::ceil(center.y_px - half_px)));
  const int right =
      std::min(painted.width() - 1, static_cast<int>(std::floor(center.x_px + half_px)));
  const int bottom =
      std::min(painted.height() - 1, static_cast<int>(std::floor(center.y_px + half_px)));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) painted.Set(x, y);
  }
}

/// Draws a hull as a camera would see it.
void PaintHull(const VoxelGrid& hull, const CarvingView& view, Silhouette& painted) {
  painted.Reset(view.silhouette->width(), view.silhouette->height());
  ForEachVoxel(hull, [&](int i, int j, int k) {
    if (hull.IsEnclosed(i, j, k)) return;
    const Vector3 p_C = view.X_CW * hull.CenterOf(i, j, k);
    if (p_C.z() <= 0) return;
    const auto u = static_cast<float>(p_C.x() / p_C.z());
    const auto v = static_cast<float>(p_C.y() / p_C.z());
    const auto half = static_cast<float>(kHalfOutline * hull.voxel_mm() / p_C.z());
    SensorPlaneTable::Place center, right;
    if (!view.table->Locate(u, v, center) || !view.table->Locate(u + half, v, right)) return;
    PaintSquare(center, std::hypot(right.x_px - center.x_px, right.y_px - center.y_px), painted);
  });
}

}  // namespace

HullAgreement::HullAgreement() : carver_({.voxel_mm = kVoxel_mm}) {}

const std::vector<std::optional<SilhouetteShift>>& HullAgreement::Measure(
    std::span<const CarvingView> views) {
  shifts_.clear();
  for (std::size_t i = 0; i < views.size(); ++i) shifts_.push_back(MeasureOne(views, i));
  return shifts_;
}

std::optional<SilhouetteShift> HullAgreement::MeasureOne(std::span<const CarvingView> views,
                                                         std::size_t view) {
  if (TouchesBorder(*views[view].silhouette)) return {};
  others_.clear();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const bool is_held_against = IsOther(i, view, views.size());
    if (is_held_against && views[i].silhouette->BoundingBox()) others_.push_back(views[i]);
  }
  if (others_.size() < kFewestOthers) return {};
  carver_.Carve(others_, hull_);
  PaintHull(hull_, views[view], expected_);
  if (TouchesBorder(expected_)) return {};
  const SilhouetteShift shift = MeasureShift(*views[view].silhouette, expected_);
  if (shift.overlap < kLeastOverlap) return {};
  return shift;
}

std::optional<Vector3> HullAgreement::PlaceOf(std::span<const CarvingView> views) {
  carver_.Carve(views, hull_);
  Vector3 sum = Vector3::Zero();
  int count = 0;
  ForEachVoxel(hull_, [&](int i, int j, int k) {
    sum += hull_.CenterOf(i, j, k);
    ++count;
  });
  if (count == 0) return {};
  return sum / count;
}

}  // namespace mocap
