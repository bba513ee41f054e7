#include "core/tracking/bounding_edges.h"

#include <algorithm>
#include <optional>

namespace mocap {
namespace {

// As shares of a voxel: how far apart a ray is looked at, and how far inside of it.
constexpr double kStep = 0.8;
constexpr double kInward = 0.7;

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

}  // namespace

void FindBoundingEdges(const VoxelCloud& cloud, std::span<const GrazingRay> rays,
                       std::vector<BoundingEdge>& edges) {
  edges.clear();
  const double step_mm = kStep * cloud.voxel_mm();
  for (const GrazingRay& ray : rays) {
    const Vector3 eye_W = ray.eye_W - kInward * cloud.voxel_mm() * ray.outward_W;
    const std::optional<Range> range = Within(cloud.box_W(), eye_W, ray.direction_W);
    if (!range) continue;
    double first_mm = -1;
    double last_mm = -1;
    for (double t = range->from_mm; t < range->to_mm; t += step_mm) {
      if (cloud.IndexAt(Vector3(eye_W + t * ray.direction_W)) < 0) continue;
      if (first_mm < 0) first_mm = t;
      last_mm = t;
    }
    if (first_mm < 0) continue;
    edges.push_back({ray.eye_W + first_mm * ray.direction_W, ray.eye_W + last_mm * ray.direction_W,
                     ray.outward_W});
  }
}

}  // namespace mocap
