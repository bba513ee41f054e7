// The evidence of one frame set: voxels and outlines of the person.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/evidence/bounding_edges.h"
#include "core/evidence/feet.h"
#include "core/evidence/keypoint_rays.h"
#include "core/evidence/ray_motion.h"
#include "core/motion_capture.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap {

/// Whether flesh begins higher above the floor than the shins, so that the legs were carved away or
/// are in the air.
/// @param lowest_mm  height at which it begins.
inline bool LacksLegs(double lowest_mm) {
  constexpr double kShinMm = 250;
  return lowest_mm > kShinMm;
}

/// The person as voxels and bounding edges, and the silhouette borders that flesh does not cross.
/// Reuses its memory.
struct Evidence {
  VoxelCloud cloud;
  std::vector<Outline> borders;  ///< One per camera; empty for cameras that are missing.
  std::vector<BoundingEdge> edges;
  std::optional<Vector3> toes_W;               ///< Where the feet point; see FeetFinder.
  std::vector<KeypointRays> keypoints;         ///< Of this set.
  std::vector<KeypointRays> recent_keypoints;  ///< Also of the sets before; only if any are new.
  FeetFinder feet_finder;
  RayMotion ray_motion;

  /// Gathers what a set shows.
  /// @param motion  of the person; null: not known.
  void Gather(const Observation& observation, const PersonMotion* motion = nullptr) {
    cloud.Build(observation.flesh, observation.room);
    borders.assign(observation.borders.begin(), observation.borders.end());
    FindBoundingEdges(cloud, observation.outlines, observation.box_W, edges);
    keypoints.assign(observation.keypoints.begin(), observation.keypoints.end());
    if (motion) {
      ray_motion.BringToSet(*motion, observation.box_W, edges, borders);
      for (KeypointRays& view : keypoints) BringToSet(*motion, view);
    }
    toes_W = feet_finder.ToesBeforeShins(cloud);
  }

  /// Share of the edges that miss the hull: holes and stray blobs of silhouettes.
  double MissingShare() const {
    const auto missing = std::ranges::count_if(edges, &BoundingEdge::misses_hull);
    return static_cast<double>(missing) /
           static_cast<double>(std::max<std::size_t>(1, edges.size()));
  }
};

}  // namespace mocap
