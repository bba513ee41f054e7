#include "core/tracking/contact.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

// A place on the inside of the left leg is no evidence for the right one: surfaces that face
// square to each other count as this far apart.
constexpr double kSquare_mm = 40;

}  // namespace

void ChooseContacts(const Evidence& evidence, int voxels, int edges,
                    std::vector<Contact>& contacts) {
  contacts.clear();
  const std::vector<int>& surface = evidence.cloud.surface();
  const std::size_t from_surface = std::min<std::size_t>(surface.size(), voxels);
  for (std::size_t i = 0; i < from_surface; ++i) {
    const Voxel& voxel = evidence.cloud.voxels()[surface[i * surface.size() / from_surface]];
    contacts.push_back({voxel.center_W, voxel.center_W, voxel.normal_W, false});
  }
  const std::size_t from_edges = std::min<std::size_t>(evidence.edges.size(), edges);
  for (std::size_t i = 0; i < from_edges; ++i) {
    const BoundingEdge& edge = evidence.edges[i * evidence.edges.size() / from_edges];
    contacts.push_back({edge.from_W, edge.to_W, edge.outward_W, true});
  }
}

ContactMatch MatchContact(const Contact& contact, std::span<const PosedCapsule> capsules,
                          double reach_mm) {
  ContactMatch best;
  best.mismatch_mm = reach_mm;
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    const PosedCapsule::SegmentDistance distance =
        capsules[i].DistanceTo(contact.from_W, contact.to_W);
    const double apart_mm = std::abs(distance.outside_mm);
    if (apart_mm >= best.mismatch_mm) continue;
    const Vector3 offset = distance.segment_W - distance.core_W;
    const double facing = contact.outward_W.dot(offset) / (offset.norm() + 1);
    const double mismatch_mm = apart_mm + kSquare_mm * (1 - facing);
    if (mismatch_mm >= best.mismatch_mm) continue;
    best = {static_cast<int>(i), distance, mismatch_mm};
  }
  return best;
}

}  // namespace mocap
