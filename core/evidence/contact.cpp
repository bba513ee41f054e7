#include "core/evidence/contact.h"

#include "core/kernels/spread_choice.h"

namespace mocap {

void ChooseContacts(const Evidence& evidence, int voxels, int edges,
                    std::vector<Contact>& contacts) {
  contacts.clear();
  const VoxelCloud& cloud = evidence.cloud;
  // Grids move with the person; cells of the room do not.
  const Eigen::Vector3i origin =
      (cloud.box_W().min() / cloud.voxel_mm()).array().round().cast<int>();
  const auto rank_of = [&](const Voxel& voxel) { return RankOfCell(origin + voxel.cell); };
  SpreadChoice of_voxels;
  for (const int index : cloud.surface()) of_voxels.Add(rank_of(cloud.voxels()[index]));
  const std::uint64_t last_voxel = of_voxels.LimitFor(static_cast<std::size_t>(voxels));
  for (const int index : cloud.surface()) {
    const Voxel& voxel = cloud.voxels()[index];
    if (rank_of(voxel) < last_voxel)
      contacts.push_back({{voxel.center_W, voxel.center_W, cloud.NormalAt(voxel)}, false});
  }
  SpreadChoice of_edges;
  for (const BoundingEdge& edge : evidence.edges) of_edges.Add(edge.rank);
  const std::uint64_t last_edge = of_edges.LimitFor(static_cast<std::size_t>(edges));
  for (const BoundingEdge& edge : evidence.edges) {
    if (edge.rank < last_edge) contacts.push_back({edge, true, edge.misses_hull});
  }
}

}  // namespace mocap
