// Contacts: points and rays that the body's surface should touch.
#pragma once

#include <span>
#include <vector>

#include "core/body/segment_matcher.h"
#include "core/evidence/evidence.h"

namespace mocap {

/// A point on the voxels' surface (from_W = to_W), or a bounding edge.
struct Contact : OrientedSegment {
  bool is_edge;
  bool misses_hull = false;  ///< An edge of something that was carved away.
};

/// Selects contacts, spread evenly over a frame's surface voxels and bounding edges. Where nothing
/// moves, the choice stays: otherwise a still body would tremble. Voxels come first. Reuses the
/// memory of `contacts`.
/// @param voxels, edges  limits for their numbers.
void ChooseContacts(const Evidence& evidence, int voxels, int edges,
                    std::vector<Contact>& contacts);

}  // namespace mocap
