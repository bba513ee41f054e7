// A person's flesh as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "tools/interchange/skeleton_motion.h"
#include "tools/results/result.h"

namespace mocap {

struct MeshVertex {
  Vector3 p_T;       ///< With all joints at rest, in the torso's frame [mm].
  Vector3 normal_T;  ///< Of length 1, outward.
  SkeletonJoint joint = SkeletonJoint::kHips;  ///< Which carries it.
};

struct BodyMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::array<std::uint16_t, 3>> triangles;  ///< Counter-clockwise from outside.
};

/// Makes the capsules that a body was tracked with, with its measured sizes.
BodyMesh MakeBodyMesh(const BodyRecord& body);

}  // namespace mocap
