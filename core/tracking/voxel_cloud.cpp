#include "core/tracking/voxel_cloud.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace mocap {
namespace {

// A piece that is torn off the body is kept from this share of the body on, and this near to it.
constexpr double kPieceShare = 0.005;
constexpr double kPieceReachMm = 150;

template <typename Visit>
void ForEachInCube(int radius, const Visit& visit) {
  for (int dz = -radius; dz <= radius; ++dz) {
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) visit(Eigen::Vector3i(dx, dy, dz));
    }
  }
}

}  // namespace

int VoxelCloud::IndexAt(const Vector3& p_W) const {
  const Vector3 cell = ((p_W - origin_W_) / voxel_mm_).array().floor();
  return IndexAt(Eigen::Vector3i(cell.cast<int>()));
}

Vector3 VoxelCloud::Centroid() const {
  Vector3 sum = Vector3::Zero();
  for (const Voxel& voxel : voxels_) sum += voxel.center_W;
  return empty() ? sum : Vector3(sum / size());
}

void VoxelCloud::Build(const VoxelGrid& grid) {
  size_ = grid.size();
  origin_W_ = grid.origin_W();
  voxel_mm_ = grid.voxel_mm();
  voxels_.clear();
  surface_.clear();
  const Eigen::Matrix<std::size_t, 3, 1> padded = (size_.array() + 2 * kMargin).cast<std::size_t>();
  index_of_slot_.assign(padded.prod(), -1);
  for (int k = 0; k < size_.z(); ++k) {
    for (int j = 0; j < size_.y(); ++j) {
      const std::uint64_t* row = grid.row(j, k);
      for (int word = 0; word < grid.words_per_row(); ++word) {
        for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1) {
          const Eigen::Vector3i cell(word * 64 + std::countr_zero(bits), j, k);
          index_of_slot_[SlotOf(cell)] = size();
          voxels_.push_back({.center_W = grid.CenterOf(cell.x(), j, k), .cell = cell});
        }
      }
    }
  }
  DropIslands();
  FindSurface();
}

std::vector<std::ptrdiff_t> VoxelCloud::CubeOffsets(int radius) const {
  std::vector<std::ptrdiff_t> offsets;
  const std::ptrdiff_t middle = SlotOf(Eigen::Vector3i::Zero());
  ForEachInCube(radius,
                [&](const Eigen::Vector3i& step) { offsets.push_back(SlotOf(step) - middle); });
  return offsets;
}

void VoxelCloud::DropIslands() {
  component_.assign(voxels_.size(), -1);
  std::vector<int> sizes;
  const std::vector<std::ptrdiff_t> neighbours = CubeOffsets(1);
  for (int seed = 0; seed < size(); ++seed) {
    if (component_[seed] >= 0) continue;
    const int component = static_cast<int>(sizes.size());
    sizes.push_back(0);
    component_[seed] = component;
    stack_.assign(1, seed);
    while (!stack_.empty()) {
      const std::ptrdiff_t slot = SlotOf(voxels_[stack_.back()].cell);
      stack_.pop_back();
      ++sizes[component];
      for (const std::ptrdiff_t offset : neighbours) {
        const int neighbour = index_of_slot_[slot + offset];
        if (neighbour < 0 || component_[neighbour] >= 0) continue;
        component_[neighbour] = component;
        stack_.push_back(neighbour);
      }
    }
  }
  if (sizes.size() <= 1) return;

  const int body = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<bool> near_body(sizes.size(), false);
  const int reach = static_cast<int>(kPieceReachMm / voxel_mm_);
  for (int i = 0; i < size(); ++i) {
    const int component = component_[i];
    if (near_body[component] || sizes[component] < kPieceShare * sizes[body]) continue;
    ForEachInCube(reach, [&](const Eigen::Vector3i& step) {
      const int neighbour = IndexAt(Eigen::Vector3i(voxels_[i].cell + step));
      if (neighbour >= 0 && component_[neighbour] == body) near_body[component] = true;
    });
  }

  int kept = 0;
  for (int i = 0; i < size(); ++i) {
    const bool keep = component_[i] == body || near_body[component_[i]];
    index_of_slot_[SlotOf(voxels_[i].cell)] = keep ? kept : -1;
    if (keep) voxels_[kept++] = voxels_[i];
  }
  voxels_.resize(kept);
}

void VoxelCloud::FindSurface() {
  const std::ptrdiff_t middle = SlotOf(Eigen::Vector3i::Zero());
  const std::array<std::ptrdiff_t, 3> faces = {SlotOf(Eigen::Vector3i::UnitX()) - middle,
                                               SlotOf(Eigen::Vector3i::UnitY()) - middle,
                                               SlotOf(Eigen::Vector3i::UnitZ()) - middle};
  for (int i = 0; i < size(); ++i) {
    const std::ptrdiff_t slot = SlotOf(voxels_[i].cell);
    voxels_[i].surface = std::ranges::any_of(faces, [&](std::ptrdiff_t face) {
      return index_of_slot_[slot + face] < 0 || index_of_slot_[slot - face] < 0;
    });
    if (voxels_[i].surface) surface_.push_back(i);
  }
}

Vector3 VoxelCloud::NormalAt(const Voxel& voxel) const {
  // Wide enough that a normal does not follow the steps of the grid.
  const int radius = std::clamp(static_cast<int>(std::lround(50 / voxel_mm_)), 1, kMargin);
  Vector3 inward = Vector3::Zero();
  ForEachInCube(radius, [&](const Eigen::Vector3i& step) {
    if (index_of_slot_[SlotOf(voxel.cell + step)] >= 0) inward += step.cast<double>();
  });
  const double length = inward.norm();
  return length > 0 ? Vector3(-inward / length) : Vector3::Zero();
}

}  // namespace mocap
