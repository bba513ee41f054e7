#include "core/evidence/bounding_edges.h"

#include <cmath>
#include <optional>

#include "core/reconstruction/silhouette/line_range.h"

namespace mocap {
namespace {

// Along a ray, and of the test line towards the inside [voxels].
struct Cut {
  double step = 0.8, inward = 0.7;
};
constexpr Cut kCut{};

// The part of a ray along the voxels; empty if it misses them.
std::optional<LineRange> AlongVoxels(const VoxelCloud& cloud, const GrazingRay& ray,
                                     const LineRange& in_box) {
  const double step_mm = kCut.step * cloud.voxel_mm();
  const Vector3 eye_W = ray.eye_W - kCut.inward * cloud.voxel_mm() * ray.outward_W;
  const int steps = static_cast<int>(std::ceil((in_box.to_mm - in_box.from_mm) / step_mm));
  const VoxelCloud::Places places =
      cloud.PlacesAlong(eye_W + in_box.from_mm * ray.direction_W, step_mm * ray.direction_W);
  const VoxelCloud::Stretch stretch = cloud.StretchOf(places, steps);
  const std::optional<int> first = cloud.FirstHeld(places, stretch);
  if (!first) return std::nullopt;
  const int last = cloud.LastHeld(places, stretch);
  return LineRange{in_box.from_mm + *first * step_mm, in_box.from_mm + last * step_mm};
}

}  // namespace

void FindBoundingEdges(const VoxelCloud& cloud, std::span<const Outline> outlines,
                       const Eigen::AlignedBox3d& box_W, std::vector<BoundingEdge>& edges) {
  edges.clear();
  for (std::size_t camera = 0; camera < outlines.size(); ++camera) {
    for (const GrazingRay& ray : outlines[camera]) {
      const std::optional<LineRange> in_box = RangeWithin(box_W, ray.eye_W, ray.direction_W);
      if (!in_box) continue;
      const std::optional<LineRange> stretch = AlongVoxels(cloud, ray, *in_box);
      const LineRange range = stretch.value_or(*in_box);
      edges.push_back({{ray.eye_W + range.from_mm * ray.direction_W,
                        ray.eye_W + range.to_mm * ray.direction_W, ray.outward_W},
                       !stretch,
                       ray.rank,
                       static_cast<int>(camera)});
    }
  }
}

}  // namespace mocap
