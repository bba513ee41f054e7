// Outer border of a silhouette, as rays into the room.
#pragma once

#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// A corner of the convex hull of a silhouette.
struct HullCorner {
  Vector3 ray_W;            ///< Unit vector from the lens.
  bool is_at_edge = false;  ///< Of the picture: the person goes on beyond it.
};

/// What a camera saw of everybody at a moment; no corners: nobody.
struct SeenHull {
  double time_s = 0;
  std::vector<HullCorner> corners;
};

/// Hulls of a fixed camera over time.
struct CameraHulls {
  Vector3 lens_W;
  double pixel_rad = 0;  ///< What a pixel covers, at the middle of the picture.
  int height_px = 0;
  std::vector<SeenHull> frames;  ///< By ascending times.
};

/// The hull of a silhouette, whose lens distortion is removed first: straight lines stay straight,
/// so tangents of the hull are tangents of the silhouette.
std::vector<HullCorner> HullOf(const Silhouette& silhouette, const CameraCalibration& camera);

/// The largest connected part of a silhouette: somebody who moves, without bystanders.
Silhouette LargestPart(const Silhouette& silhouette);

/// Hulls of a camera, without frames yet.
CameraHulls NoHulls(const CameraCalibration& camera);

}  // namespace mocap
