#include "core/people/flesh_division.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/reconstruction/carving/voxel_block.h"

namespace mocap {
namespace {

// A piece too small for a person belongs to a body that is closer than this.
constexpr double kBesideFleshMm = 300;
// Cells around a share, so that normals follow from its surroundings.
constexpr int kMargin = 3;
constexpr double kFar = std::numeric_limits<double>::infinity();

Eigen::AlignedBox3d BoxOf(const Eigen::AlignedBox3i& cells, const VoxelGrid& grid) {
  if (cells.isEmpty()) return {};
  const Eigen::Vector3i past = cells.max() + Eigen::Vector3i::Ones();
  return {grid.origin_W() + grid.voxel_mm() * cells.min().cast<double>(),
          grid.origin_W() + grid.voxel_mm() * past.cast<double>()};
}

Eigen::AlignedBox3i CellsOf(std::span<const VoxelPieces::Run> runs) {
  Eigen::AlignedBox3i cells;
  for (const VoxelPieces::Run& run : runs) {
    cells.extend(Eigen::Vector3i(run.begin, run.j, run.k));
    cells.extend(Eigen::Vector3i(run.end - 1, run.j, run.k));
  }
  return cells;
}

void Cut(const VoxelGrid& room, const VoxelGrid& flesh, const Eigen::AlignedBox3i& cells,
         FleshShare& share) {
  const Eigen::Vector3i margin = Eigen::Vector3i::Constant(kMargin);
  const Eigen::AlignedBox3i grid(Eigen::Vector3i::Zero(), room.size() - Eigen::Vector3i::Ones());
  Eigen::AlignedBox3i block;
  if (!cells.isEmpty()) block = grid.intersection({cells.min() - margin, cells.max() + margin});
  share.box_W = BoxOf(cells, room);
  CopyBlock(flesh, block, share.flesh);
  CopyBlock(room, block, share.room);
}

}  // namespace

void FleshDivision::Divide(const VoxelGrid& grid, std::span<const PosedPerson> people) {
  claims_.resize(people.size());
  for (Claim& claim : claims_) claim.Clear(grid);
  strange_.Reset(grid.first_voxel(), grid.size(), grid.voxel_mm());
  ForEachVoxel(grid, [&](int i, int j, int k) {
    FindOwners(grid.CenterOf(i, j, k), people);
    if (owners_.empty()) strange_.Set(i, j, k);
    for (const int owner : owners_) claims_[owner].Add(i, j, k);
  });
  DivideStrangeFlesh();
  people_ = people.size();
  shares_.resize(claims_.size());
  for (std::size_t i = 0; i < claims_.size(); ++i)
    Cut(grid, claims_[i].grid, claims_[i].cells, shares_[i]);
}

// Finds the person nearest to a point. Flesh that no body explains may belong to a lost limb:
// everybody in reach owns it.
void FleshDivision::FindOwners(const Vector3& p_W, std::span<const PosedPerson> people) {
  owners_.clear();
  const auto is_near = [&](const PosedPerson& person) { return person.box_W.contains(p_W); };
  const bool is_contested = std::ranges::count_if(people, is_near) > 1;
  double least_mm = kFar;
  for (int i = 0; i < static_cast<int>(people.size()); ++i) {
    if (!is_near(people[i])) continue;
    const double distance_mm =
        DistanceTo(people[i], p_W, is_contested ? -kFar : people[i].reach_mm);
    if (distance_mm >= people[i].reach_mm) continue;
    owners_.push_back(i);
    if (distance_mm >= least_mm) continue;
    least_mm = distance_mm;
    std::swap(owners_.front(), owners_.back());
  }
  if (least_mm <= kExplainsMm) owners_.resize(1);
}

// Small pieces come after strangers, because they may be theirs.
void FleshDivision::DivideStrangeFlesh() {
  pieces_.Find(strange_);
  runs_ = pieces_.runs();
  const auto order = [&](const VoxelPieces::Run& run) {
    return std::tuple(-pieces_.sizes()[run.piece], run.piece);
  };
  std::ranges::stable_sort(runs_, {}, order);
  const double voxel_litres = std::pow(strange_.voxel_mm() / 100, 3);
  for (auto begin = runs_.begin(); begin != runs_.end();) {
    const int piece = begin->piece;
    const auto end = std::find_if(begin, runs_.end(),
                                  [&](const VoxelPieces::Run& run) { return run.piece != piece; });
    if (pieces_.sizes()[piece] * voxel_litres >= kPerson.litres)
      MakeStrangers({begin, end});
    else
      GiveToNearest({begin, end});
    begin = end;
  }
}

void FleshDivision::MakeStrangers(Runs piece) {
  watershed_.Divide(piece, strange_, kPerson);
  const std::size_t first = claims_.size();
  claims_.resize(first + watershed_.count());
  for (std::size_t i = first; i < claims_.size(); ++i) claims_[i].Clear(strange_);
  for (const VoxelPieces::Run& run : piece)
    for (int i = run.begin; i < run.end; ++i)
      claims_[first + watershed_.HillAt(i, run.j)].Add(i, run.j, run.k);
}

void FleshDivision::GiveToNearest(Runs piece) {
  const Eigen::AlignedBox3d box_W = BoxOf(CellsOf(piece), strange_);
  Claim* nearest = nullptr;
  double least_mm = kBesideFleshMm;
  for (Claim& claim : claims_) {
    if (claim.cells.isEmpty()) continue;
    const double gap_mm = BoxOf(claim.cells, strange_).exteriorDistance(box_W);
    if (gap_mm < least_mm) least_mm = gap_mm, nearest = &claim;
  }
  for (const VoxelPieces::Run& run : piece)
    for (int i = run.begin; nearest && i < run.end; ++i) nearest->Add(i, run.j, run.k);
}

}  // namespace mocap
