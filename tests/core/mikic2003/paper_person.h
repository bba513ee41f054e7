// A person of the paper's body (§5.2), as voxels of its 25 mm.
#pragma once

#include <algorithm>
#include <vector>

#include "config/load_config.h"
#include "core/body/body_model.h"
#include "core/body/stance.h"
#include "core/mikic2003/limbs.h"
#include "core/reconstruction/carving/voxel_cloud.h"
#include "tests/support/voxelized_shapes.h"

namespace mocap::mikic2003 {

/// Arms and legs away from the torso, knees and elbows bent: all parts can be told apart.
inline constexpr ArmStance kArmAside{.raise = -20, .elbow = 40};
inline constexpr LegStance kLegAside{.hip = 10, .spread = 20, .knee = 25};
inline const Stance kSpread{
    .arm_l = kArmAside, .arm_r = kArmAside, .leg_l = kLegAside, .leg_r = kLegAside};

/// An ellipsoid for the head, an elliptic cylinder for the torso, round rods for the limbs.
struct PaperPerson {
  explicit PaperPerson(double stature_mm = 1750)
      : body(LoadBodyTable("mikic2003"), SizesOf(stature_mm)) {}

  /// The paper's head sits on the neck; a thigh is thinner than a head, as it is where it tapers.
  static BodySizes SizesOf(double stature_mm) {
    BodySizes sizes = AverageSizes(stature_mm);
    sizes.head_width = 180;
    sizes.thigh_width = 150;
    sizes.neck = sizes.head / 2;
    return sizes;
  }

  PoseState Pose(const Stance& stance, double turned_rad = 0.4,
                 const Vector3& at_W = {200, -100, 1220}) const {
    PoseState pose;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, turned_rad));
    pose.X_WT.p = at_W;
    pose.theta = AnglesOf(stance, body.table());
    return pose;
  }
  Vector3 Place(const PoseState& pose, Point point) const {
    return body.PointsAt(body.PostureAt(pose)).col(static_cast<int>(point));
  }

  /// All 23 points, as a measurement without error.
  MeasuredPoints Points(const PoseState& pose) const {
    MeasuredPoints points;
    for (int i = 0; i < kPointCount; ++i) points[i] = Place(pose, static_cast<Point>(i));
    return points;
  }

  VoxelGrid Grid(const PoseState& pose) const {
    const Posture posture = body.PostureAt(pose);
    const BodyPoints points_W = body.PointsAt(posture);
    const auto at = [&](Point point) { return Vector3(points_W.col(static_cast<int>(point))); };
    const BodySizes& sizes = body.sizes();
    std::vector<PosedCapsule> rods;
    for (const Limb& limb : kLimbs) {
      rods.emplace_back(at(limb.root), at(limb.joint), sizes.*limb.upper_width / 2,
                        sizes.*limb.upper_width / 2);
      rods.emplace_back(at(limb.joint), at(limb.end), sizes.*limb.lower_width / 2,
                        sizes.*limb.lower_width / 2);
    }
    const Vector3 head_W = at(Point::kHead);
    const auto is_inside = [&](const Vector3& p_W) {
      const Vector3 p_T = posture.X_WT.Inverse() * p_W;
      const double x = 2 * p_T.x() / sizes.torso_depth, y = 2 * p_T.y() / sizes.torso_width;
      if (std::abs(p_T.z()) < sizes.torso / 2 && x * x + y * y < 1) return true;
      const Vector3 from_head_T = posture.X_WT.R.transpose() * (p_W - head_W);
      const Vector3 half(sizes.head_width / 2, sizes.head_width / 2, sizes.head / 2);
      if (from_head_T.cwiseQuotient(half).squaredNorm() < 1) return true;
      return std::ranges::any_of(
          rods, [&](const PosedCapsule& rod) { return rod.DistanceTo(p_W).outside_mm < 0; });
    };
    const Vector3 low = points_W.rowwise().minCoeff().array() - 250;
    const Vector3 high = points_W.rowwise().maxCoeff().array() + 250;
    return FillGrid(low, high, 25, is_inside);
  }
  VoxelCloud Cloud(const PoseState& pose) const {
    VoxelCloud cloud;
    cloud.Build(Grid(pose));
    return cloud;
  }

  BodyModel body;
};

}  // namespace mocap::mikic2003
