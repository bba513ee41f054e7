// What the body's surface should touch, and which part of a posed body does.
#pragma once

#include <span>
#include <vector>

#include "core/body/body_shape.h"
#include "core/tracking/evidence.h"

namespace mocap {

/// A place on the surface of the voxels (from_W = to_W), or a bounding edge.
struct Contact {
  Vector3 from_W;
  Vector3 to_W;
  Vector3 outward_W;  ///< The surface's normal there.
  bool is_edge;
};

/// Chooses contacts spread evenly over a frame's surface voxels and bounding edges; keeps the
/// memory of `contacts`. Voxels come first.
void ChooseContacts(const Evidence& evidence, int voxels, int edges,
                    std::vector<Contact>& contacts);

/// The part of a body that explains a contact best.
struct ContactMatch {
  int capsule = -1;  ///< -1: none within reach.
  PosedCapsule::SegmentDistance distance{};
  double mismatch_mm = 0;  ///< Distance and, in millimetres, how far the surfaces face apart.
};

/// Finds the capsule that lies nearest and faces the same way.
/// @param reach_mm  mismatch from which on a capsule does not explain the contact.
/// @param likely    a capsule to try first, or -1: saves time when it is the one.
ContactMatch MatchContact(const Contact& contact, std::span<const PosedCapsule> capsules,
                          double reach_mm, int likely = -1);

}  // namespace mocap
