#include "core/tracking/bounding_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mocap {
namespace {

// As shares of a voxel: how far apart a ray is looked at, and how far inside of it.
constexpr double kStep = 0.8;
constexpr double kInward = 0.7;
// Share of a camera's rays.
constexpr double kMostMissing = 1.0 / 3;

struct Range {
  double from_mm;
  double to_mm;
};

// Where a line runs through a box.
std::optional<Range> Within(const Eigen::AlignedBox3d& box, const Vector3& eye,
                            const Vector3& direction) {
  const Vector3 a = (box.min() - eye).cwiseQuotient(direction);
  const Vector3 b = (box.max() - eye).cwiseQuotient(direction);
  const double from = std::max(0.0, a.cwiseMin(b).maxCoeff());
  const double to = a.cwiseMax(b).minCoeff();
  if (!(from < to)) return std::nullopt;
  return Range{from, to};
}

// The stretch of a ray along the voxels; empty where it misses them.
std::optional<Range> AlongVoxels(const VoxelCloud& cloud, const GrazingRay& ray,
                                 const Range& in_box) {
  const double step_mm = kStep * cloud.voxel_mm();
  const Vector3 eye_W = ray.eye_W - kInward * cloud.voxel_mm() * ray.outward_W;
  const int steps = static_cast<int>(std::ceil((in_box.to_mm - in_box.from_mm) / step_mm));
  const VoxelCloud::Places places =
      cloud.PlacesAlong(eye_W + in_box.from_mm * ray.direction_W, step_mm * ray.direction_W);
  const VoxelCloud::Stretch stretch = cloud.StretchOf(places, steps);
  const std::optional<int> first = cloud.FirstHeld(places, stretch);
  if (!first) return std::nullopt;
  const int last = cloud.LastHeld(places, stretch);
  return Range{in_box.from_mm + *first * step_mm, in_box.from_mm + last * step_mm};
}

BoundingEdge EdgeOf(const GrazingRay& ray, const Range& range) {
  return {ray.eye_W + range.from_mm * ray.direction_W, ray.eye_W + range.to_mm * ray.direction_W,
          ray.outward_W};
}

void AddEdges(const VoxelCloud& cloud, const Outline& outline, std::vector<BoundingEdge>& edges,
              std::vector<BoundingEdge>& missing) {
  missing.clear();
  for (const GrazingRay& ray : outline) {
    const std::optional<Range> in_box = Within(cloud.box_W(), ray.eye_W, ray.direction_W);
    if (!in_box) continue;
    if (const std::optional<Range> stretch = AlongVoxels(cloud, ray, *in_box)) {
      edges.push_back(EdgeOf(ray, *stretch));
    } else {
      missing.push_back(EdgeOf(ray, *in_box));
    }
  }
  if (static_cast<double>(missing.size()) > kMostMissing * static_cast<double>(outline.size())) {
    return;
  }
  edges.insert(edges.end(), missing.begin(), missing.end());
}

}  // namespace

void FindBoundingEdges(const VoxelCloud& cloud, std::span<const Outline> outlines,
                       std::vector<BoundingEdge>& edges, std::vector<BoundingEdge>& missing) {
  edges.clear();
  for (const Outline& outline : outlines) AddEdges(cloud, outline, edges, missing);
}

}  // namespace mocap
