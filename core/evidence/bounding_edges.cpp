#include "core/evidence/bounding_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/reconstruction/silhouette/line_range.h"

namespace mocap {
namespace {

struct Cut {
  // Along a ray, and of the test line towards the inside [voxels].
  double step = 0.8, inward = 0.7;
  double most_missing = 1.0 / 3;  // Share of a camera's rays, beyond the usual one.
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

BoundingEdge EdgeOf(const GrazingRay& ray, const LineRange& range) {
  return {{ray.eye_W + range.from_mm * ray.direction_W, ray.eye_W + range.to_mm * ray.direction_W,
           ray.outward_W},
          false,
          ray.rank,
          ray.after_s};
}

double ShareOf(int part, int all) { return static_cast<double>(part) / std::max(1, all); }

}  // namespace

void BoundingEdgeFinder::Find(const VoxelCloud& cloud, std::span<const Outline> outlines,
                              const Eigen::AlignedBox3d& box_W, std::vector<BoundingEdge>& edges) {
  edges.clear();
  cuts_.clear();
  cameras_.clear();
  for (const Outline& outline : outlines) cameras_.push_back(CutRays(cloud, outline, box_W));
  const double usual_share = UsualMissingShare();
  std::size_t i = 0;
  for (const Camera& camera : cameras_) {
    const bool errs = ShareOf(camera.missing, camera.rays) > usual_share + kCut.most_missing;
    const std::size_t end = i + camera.cuts;
    for (std::size_t cut = i; cut < end; ++cut)
      if (!cuts_[cut].misses_hull) edges.push_back(cuts_[cut]);
    for (std::size_t cut = i; cut < end && !errs; ++cut)
      if (cuts_[cut].misses_hull) edges.push_back(cuts_[cut]);
    i = end;
  }
}

BoundingEdgeFinder::Camera BoundingEdgeFinder::CutRays(const VoxelCloud& cloud,
                                                       const Outline& outline,
                                                       const Eigen::AlignedBox3d& box_W) {
  Camera camera;
  camera.rays = static_cast<int>(outline.size());
  for (const GrazingRay& ray : outline) {
    const std::optional<LineRange> in_box = RangeWithin(box_W, ray.eye_W, ray.direction_W);
    if (!in_box) continue;
    const std::optional<LineRange> stretch = AlongVoxels(cloud, ray, *in_box);
    cuts_.push_back(EdgeOf(ray, stretch.value_or(*in_box)));
    cuts_.back().misses_hull = !stretch;
    camera.missing += !stretch;
    ++camera.cuts;
  }
  return camera;
}

// Lower median over the cameras that see the person; what most cameras miss was carved away.
double BoundingEdgeFinder::UsualMissingShare() {
  shares_.clear();
  for (const Camera& camera : cameras_)
    if (camera.rays > 0) shares_.push_back(ShareOf(camera.missing, camera.rays));
  if (shares_.empty()) return 0;
  const auto middle = shares_.begin() + static_cast<std::ptrdiff_t>((shares_.size() - 1) / 2);
  std::ranges::nth_element(shares_, middle);
  return *middle;
}

}  // namespace mocap
