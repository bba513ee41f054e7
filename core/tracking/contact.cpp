#include "core/tracking/contact.h"

#include <algorithm>

namespace mocap {
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
    contacts.push_back({edge.from_W, edge.to_W, edge.outward_W, true, edge.misses_hull});
  }
}

}  // namespace mocap
