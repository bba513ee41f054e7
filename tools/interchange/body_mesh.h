// Triangle mesh of a person's body.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "tools/interchange/skeletons.h"
#include "tools/results/result.h"

namespace mocap {

struct MeshVertex {
  Vector3 p_T;       ///< With all joints at rest, in the torso frame [mm].
  Vector3 normal_T;  ///< Of length 1, outward.
  SkeletonJoint joint = SkeletonJoint::kHips;  ///< The joint that moves it.
};

struct BodyMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::array<std::uint16_t, 3>> triangles;  ///< Counter-clockwise from outside.
};

/// Makes a mesh of the capsules with which a body was tracked, in its measured sizes.
BodyMesh MakeBodyMesh(const BodyRecord& body);

}  // namespace mocap
