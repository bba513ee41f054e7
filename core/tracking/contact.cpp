#include "core/tracking/contact.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

// A place on the inside of the left leg is no evidence for the right one: surfaces that face
// square to each other count as this far apart.
constexpr double kSquare_mm = 40;

// Takes a capsule if it explains the contact better than the best so far.
void Try(const Contact& contact, std::span<const PosedCapsule> capsules, int index,
         ContactMatch& best) {
  const PosedCapsule::SegmentDistance distance =
      capsules[index].DistanceTo(contact.from_W, contact.to_W);
  const double apart_mm = std::abs(distance.outside_mm);
  if (apart_mm >= best.mismatch_mm) return;
  const Vector3 offset = distance.segment_W - distance.core_W;
  const double facing = contact.outward_W.dot(offset) / (offset.norm() + 1);
  const double mismatch_mm = apart_mm + kSquare_mm * (1 - facing);
  if (mismatch_mm < best.mismatch_mm) best = {index, distance, mismatch_mm};
}

}  // namespace

void ChooseContacts(const Evidence& evidence, int voxels, int edges,
                    std::vector<Contact>& contacts) {
  contacts.clear();
  const std::vector<int>& surface = evidence.cloud.surface();
  const std::size_t from_surface = std::min<std::size_t>(surface.size(), voxels);
  for (std::size_t i = 0; i < from_surface; ++i) {
    const Voxel& voxel = evidence.cloud.voxels()[surface[i * surface.size() / from_surface]];
    contacts.push_back({voxel.center_W, voxel.center_W, evidence.cloud.NormalAt(voxel), false});
  }
  const std::size_t from_edges = std::min<std::size_t>(evidence.edges.size(), edges);
  for (std::size_t i = 0; i < from_edges; ++i) {
    const BoundingEdge& edge = evidence.edges[i * evidence.edges.size() / from_edges];
    contacts.push_back({edge.from_W, edge.to_W, edge.outward_W, true});
  }
}

ContactMatch MatchContact(const Contact& contact, std::span<const PosedCapsule> capsules,
                          double reach_mm, int likely) {
  ContactMatch best;
  best.mismatch_mm = reach_mm;
  if (likely >= 0) Try(contact, capsules, likely, best);
  const Vector3 along_W = contact.to_W - contact.from_W;
  const double inverse_sq = 1 / std::max(along_W.squaredNorm(), 1e-9);
  for (int i = 0; i < std::ssize(capsules); ++i) {
    const Vector3 to_middle_W = capsules[i].middle_W - contact.from_W;
    const double share = std::clamp(to_middle_W.dot(along_W) * inverse_sq, 0.0, 1.0);
    const double far_mm = capsules[i].reach_mm + best.mismatch_mm;
    if ((to_middle_W - share * along_W).squaredNorm() > far_mm * far_mm) continue;
    if (i != likely) Try(contact, capsules, i, best);
  }
  return best;
}

}  // namespace mocap
