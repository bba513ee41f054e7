#include "core/evidence/feet.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

struct FootSizes {
  // Soles are below the first height; between the two is shin.
  double ankle_mm = 75, shin_mm = 175;
  double least_litres = 0.3;  // A third of a foot; smaller pieces are scraps.
  // Two large shoes side by side, and their share of a person in clothes. A larger piece is more
  // than feet: the hull between the legs of somebody who sits, or a hem.
  double most_litres = 3, most_share = 0.03;
  // Feet are 30 to 50 mm before the shins. Less is noise: of a sole that leaves the floor, or of a
  // foot under a gown.
  double least_offset_mm = 15;
};
constexpr FootSizes kFeet{};

// Number of layers of cells with their middle below a height.
int LayersBelow(const VoxelCloud& cloud, double height_mm) {
  const double layers = (height_mm - cloud.box_W().min().z()) / cloud.voxel_mm() - 0.5;
  return std::clamp(static_cast<int>(std::ceil(layers)), 0, cloud.size_cells().z());
}

}  // namespace

void FeetFinder::Measure(const VoxelCloud& cloud, int sole_layers, int shin_layers) {
  const Eigen::Vector3i& size = cloud.size_cells();
  const Vector3 first = cloud.box_W().min() / cloud.voxel_mm();
  floor_.Reset(first.array().round().cast<int>(), {size.x(), size.y(), sole_layers},
               cloud.voxel_mm());
  // Voxels are in scan order: from the floor up.
  for (const Voxel& voxel : cloud.voxels()) {
    if (voxel.cell.z() >= sole_layers) break;
    floor_.Set(voxel.cell.x(), voxel.cell.y(), voxel.cell.z());
  }
  pieces_.Find(floor_);
  feet_.assign(pieces_.sizes().size(), {});
  for (const VoxelPieces::Run& run : pieces_.runs()) {
    Foot& foot = feet_[run.piece];
    for (int i = run.begin; i < run.end; ++i) {
      foot.sole_W += floor_.CenterOf(i, run.j, run.k);
      const bool is_lowest = run.k == 0 || !floor_.Test(i, run.j, run.k - 1);
      for (int k = sole_layers; is_lowest && k < shin_layers; ++k) {
        const int above = cloud.IndexAt(Eigen::Vector3i(i, run.j, k));
        if (above < 0) continue;
        foot.shin_W += cloud.voxels()[above].center_W;
        ++foot.shin_voxels;
      }
    }
  }
}

std::optional<Vector3> FeetFinder::ToesBeforeShins(const VoxelCloud& cloud) {
  const int sole_layers = LayersBelow(cloud, kFeet.ankle_mm);
  if (sole_layers == 0) return std::nullopt;
  Measure(cloud, sole_layers, LayersBelow(cloud, kFeet.shin_mm));
  const double voxel_litres = std::pow(cloud.voxel_mm(), 3) * 1e-6;
  const double most_litres = std::min(kFeet.most_litres, kFeet.most_share * cloud.volume_litres());
  Vector3 sum_W = Vector3::Zero();
  double voxels = 0;
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const double size = pieces_.sizes()[i], litres = size * voxel_litres;
    if (litres < kFeet.least_litres || litres > most_litres) continue;
    if (feet_[i].shin_voxels == 0) continue;
    sum_W += size * (feet_[i].sole_W / size - feet_[i].shin_W / feet_[i].shin_voxels);
    voxels += size;
  }
  sum_W.z() = 0;
  if (voxels == 0 || sum_W.norm() < kFeet.least_offset_mm * voxels) return std::nullopt;
  return Vector3(sum_W / voxels);
}

}  // namespace mocap
