// Beyond the paper: division of a room's voxels among people.
#pragma once

#include <span>
#include <vector>

#include "core/people/posed_person.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/carving/voxel_pieces.h"
#include "core/reconstruction/carving/watershed.h"

namespace mocap {

/// Flesh that may be somebody's, and everybody's in the same block of cells.
struct FleshShare {
  VoxelGrid flesh, room;
  Eigen::AlignedBox3d box_W;  ///< Around `flesh` [mm]; empty if there is none.
};

/// Divides the flesh in a room among the known people, and finds flesh that belongs to nobody.
/// Reuses its memory.
///
/// A voxel belongs to the person whose predicted body is nearest. If no body explains it, it
/// belongs to everybody in reach, because it may be part of a lost limb. Flesh out of everybody's
/// reach is strange. Pieces of it that are too small for a person go to a person next to them, if
/// there is one. Strangers who touch are separated by their heads.
class FleshDivision {
 public:
  /// A piece this large may be an unknown person. Two heads are this much higher than what connects
  /// them: shoulders, or hands that meet. So are knees, but they are lower than the head of
  /// somebody who sits on the floor. A raised arm has too little flesh, and who lies is too low.
  static constexpr HillLimits kPerson{.valley_mm = 180, .top_mm = 700, .litres = 20};

  void Divide(const VoxelGrid& grid, std::span<const PosedPerson> people);

  /// One for each person, in the same order, then the strangers'.
  const std::vector<FleshShare>& shares() const { return shares_; }
  /// The people in strange flesh, those in the largest piece first.
  std::span<const FleshShare> strangers() const { return std::span(shares_).subspan(people_); }

 private:
  using Runs = std::span<const VoxelPieces::Run>;
  struct Claim {
    void Clear(const VoxelGrid& like) {
      grid.Reset(like.first_voxel(), like.size(), like.voxel_mm());
      cells.setEmpty();
    }
    void Add(int i, int j, int k) {
      grid.Set(i, j, k);
      cells.extend(Eigen::Vector3i(i, j, k));
    }
    VoxelGrid grid;
    Eigen::AlignedBox3i cells;
  };

  void FindOwners(const Vector3& p_W, std::span<const PosedPerson> people);
  void DivideStrangeFlesh();
  void MakeStrangers(Runs piece);
  void GiveToNearest(Runs piece);

  std::vector<Claim> claims_;  // Of the people, then of strangers.
  std::vector<int> owners_;    // Of a voxel.
  VoxelGrid strange_;
  VoxelPieces pieces_;
  std::vector<VoxelPieces::Run> runs_;  // Of strange flesh, piece by piece.
  Watershed watershed_;
  std::vector<FleshShare> shares_;
  std::size_t people_ = 0;
};

}  // namespace mocap
