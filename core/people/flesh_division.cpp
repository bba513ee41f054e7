#include "core/people/flesh_division.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/reconstruction/carving/voxel_block.h"

namespace mocap {
namespace {

// A piece too small for a person belongs to a body that is closer than this.
constexpr double kBesideFleshMm = 300;
// Cells around a share, so that normals follow from its surroundings.
constexpr int kMargin = 3;
constexpr double kNobody = std::numeric_limits<double>::infinity();

double DistanceTo(const PosedPerson& person, const Vector3& p_W, double enough_mm, int& guess) {
  double least_mm = person.capsules[guess].DistanceTo(p_W).outside_mm;
  if (least_mm <= enough_mm) return least_mm;
  for (int i = 0; i < static_cast<int>(person.capsules.size()); ++i) {
    const PosedCapsule& capsule = person.capsules[i];
    if ((p_W - capsule.middle_W).norm() - capsule.reach_mm >= least_mm) continue;
    const double distance_mm = capsule.DistanceTo(p_W).outside_mm;
    if (distance_mm >= least_mm) continue;
    least_mm = distance_mm;
    guess = i;
    if (least_mm <= enough_mm) break;
  }
  return least_mm;
}

Eigen::AlignedBox3d BoxOf(const Eigen::AlignedBox3i& cells, const VoxelGrid& grid) {
  const Eigen::Vector3i past = cells.max() + Eigen::Vector3i::Ones();
  return {grid.origin_W() + grid.voxel_mm() * cells.min().cast<double>(),
          grid.origin_W() + grid.voxel_mm() * past.cast<double>()};
}

double LitresOf(int voxels, double voxel_mm) {
  return voxels * voxel_mm * voxel_mm * voxel_mm * 1e-6;
}

}  // namespace

void FleshDivision::Divide(const VoxelGrid& grid, std::span<const PosedPerson> people) {
  claims_.resize(people.size());
  for (Claim& claim : claims_) {
    claim.grid.Reset(grid.first_voxel(), grid.size(), grid.voxel_mm());
    claim.cells.setEmpty();
    claim.voxels = 0;
  }
  strange_.Reset(grid.first_voxel(), grid.size(), grid.voxel_mm());
  guesses_.assign(people.size(), 0);
  for (int k = 0; k < grid.size().z(); ++k)
    for (int j = 0; j < grid.size().y(); ++j) ClaimRow(grid, j, k, people);
  DivideStrangeFlesh();
  shares_.resize(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) Cut(grid, claims_[i], shares_[i]);
  std::stable_sort(claims_.begin() + static_cast<std::ptrdiff_t>(people.size()), claims_.end(),
                   [](const Claim& a, const Claim& b) { return a.voxels > b.voxels; });
  strangers_.resize(claims_.size() - people.size());
  for (std::size_t i = 0; i < strangers_.size(); ++i)
    Cut(grid, claims_[people.size() + i], strangers_[i]);
}

bool FleshDivision::Touches(std::size_t share, const GrazingRay& ray) const {
  // As shares of a voxel: the step along the ray, and the offset of the test line towards the
  // inside.
  constexpr double kStep = 0.8, kInward = 0.7;
  const Claim& claim = claims_[share];
  if (claim.voxels == 0) return false;
  const double voxel_mm = claim.grid.voxel_mm();
  const Eigen::AlignedBox3d box_W = BoxOf(claim.cells, claim.grid);
  const Vector3 eye_W = ray.eye_W - kInward * voxel_mm * ray.outward_W;
  const Vector3 a = (box_W.min() - eye_W).cwiseQuotient(ray.direction_W);
  const Vector3 b = (box_W.max() - eye_W).cwiseQuotient(ray.direction_W);
  const double begin_mm = std::max(0.0, a.cwiseMin(b).maxCoeff());
  const double end_mm = a.cwiseMax(b).minCoeff();
  const Vector3 step = kStep * ray.direction_W;
  Vector3 cell = (eye_W + begin_mm * ray.direction_W - claim.grid.origin_W()) / voxel_mm;
  const int steps = static_cast<int>((end_mm - begin_mm) / (kStep * voxel_mm)) + 1;
  for (int i = 0; i < steps && begin_mm < end_mm; ++i, cell += step) {
    const Eigen::Vector3i at = cell.array().floor().cast<int>();
    if (claim.grid.Contains(at.x(), at.y(), at.z()) && claim.grid.Test(at.x(), at.y(), at.z()))
      return true;
  }
  return false;
}

void FleshDivision::ClaimRow(const VoxelGrid& grid, int j, int k,
                             std::span<const PosedPerson> people) {
  const std::uint64_t* const row = grid.row(j, k);
  const Vector3 first_W = grid.CenterOf(0, j, k);
  bool has_candidates = false;
  for (int word = 0; word < grid.words_per_row(); ++word) {
    if (row[word] == 0) continue;
    if (!has_candidates) {
      candidates_.clear();
      for (int i = 0; i < static_cast<int>(people.size()); ++i) {
        const Eigen::AlignedBox3d& box = people[i].box_W;
        const bool is_near = (first_W.tail<2>().array() >= box.min().tail<2>().array()).all() &&
                             (first_W.tail<2>().array() <= box.max().tail<2>().array()).all();
        if (is_near) candidates_.push_back(i);
      }
      has_candidates = true;
    }
    for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1) {
      const int x = word * 64 + std::countr_zero(bits);
      FindOwners(grid.CenterOf(x, j, k), people);
      if (owners_.empty()) strange_.Set(x, j, k);
      for (const int owner : owners_) Add({j, k, x, x + 1, 0}, claims_[owner]);
    }
  }
}

// Finds the person nearest to a point. Flesh that no body explains may belong to a lost limb:
// everybody in reach owns it.
void FleshDivision::FindOwners(const Vector3& p_W, std::span<const PosedPerson> people) {
  owners_.clear();
  double least_mm = kNobody;
  const auto is_within = [&](int i) {
    return p_W.x() >= people[i].box_W.min().x() && p_W.x() <= people[i].box_W.max().x();
  };
  const bool is_contested = std::ranges::count_if(candidates_, is_within) > 1;
  for (const int i : candidates_) {
    if (!is_within(i)) continue;
    const PosedPerson& person = people[i];
    const double enough_mm = is_contested ? -kNobody : person.reach_mm;
    const double distance_mm = DistanceTo(person, p_W, enough_mm, guesses_[i]);
    if (distance_mm > person.reach_mm) continue;
    owners_.push_back(i);
    if (distance_mm >= least_mm) continue;
    least_mm = distance_mm;
    std::swap(owners_.front(), owners_.back());
  }
  const bool is_explained = least_mm <= kExplainsMm;
  if (is_explained) owners_.erase(owners_.begin() + 1, owners_.end());
}

void FleshDivision::DivideStrangeFlesh() {
  pieces_.Find(strange_);
  const std::vector<int>& sizes = pieces_.sizes();
  const int pieces = static_cast<int>(sizes.size());
  owner_of_piece_.assign(sizes.size(), -1);
  piece_cells_.assign(sizes.size(), Eigen::AlignedBox3i());
  for (const VoxelPieces::Run& run : pieces_.runs()) {
    piece_cells_[run.piece].extend(Eigen::Vector3i(run.begin, run.j, run.k));
    piece_cells_[run.piece].extend(Eigen::Vector3i(run.end - 1, run.j, run.k));
  }
  const auto is_large = [&](int piece) {
    return LitresOf(sizes[piece], strange_.voxel_mm()) >= kPerson.litres;
  };
  for (int piece = 0; piece < pieces; ++piece)
    if (is_large(piece)) MakeStrangers(piece);
  for (int piece = 0; piece < pieces; ++piece)
    if (!is_large(piece)) owner_of_piece_[piece] = ClaimBeside(piece_cells_[piece]);
  for (const VoxelPieces::Run& run : pieces_.runs())
    if (owner_of_piece_[run.piece] >= 0) Add(run, claims_[owner_of_piece_[run.piece]]);
}

void FleshDivision::MakeStrangers(int piece) {
  runs_.clear();
  for (const VoxelPieces::Run& run : pieces_.runs())
    if (run.piece == piece) runs_.push_back(run);
  watershed_.Divide(runs_, strange_, kPerson);
  const std::size_t first = claims_.size();
  for (int person = 0; person < watershed_.count(); ++person)
    claims_.emplace_back().grid.Reset(strange_.first_voxel(), strange_.size(), strange_.voxel_mm());
  for (const VoxelPieces::Run& run : runs_) {
    for (int x = run.begin; x < run.end; ++x) {
      const auto person = static_cast<std::size_t>(watershed_.HillAt(x, run.j));
      Add({run.j, run.k, x, x + 1, piece}, claims_[first + person]);
    }
  }
}

// Returns whose flesh is next to a piece; -1: nobody's.
int FleshDivision::ClaimBeside(const Eigen::AlignedBox3i& cells) const {
  const Eigen::AlignedBox3d box_W = BoxOf(cells, strange_);
  int nearest = -1;
  double least_mm = kBesideFleshMm;
  for (std::size_t i = 0; i < claims_.size(); ++i) {
    if (claims_[i].cells.isEmpty()) continue;
    const double gap_mm = BoxOf(claims_[i].cells, strange_).exteriorDistance(box_W);
    if (gap_mm >= least_mm) continue;
    least_mm = gap_mm;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

void FleshDivision::Add(const VoxelPieces::Run& run, Claim& claim) {
  for (int x = run.begin; x < run.end; ++x) claim.grid.Set(x, run.j, run.k);
  claim.cells.extend(Eigen::Vector3i(run.begin, run.j, run.k));
  claim.cells.extend(Eigen::Vector3i(run.end - 1, run.j, run.k));
  claim.voxels += run.length();
}

void FleshDivision::Cut(const VoxelGrid& grid, const Claim& claim, FleshShare& share) const {
  share.litres = LitresOf(claim.voxels, grid.voxel_mm());
  share.box_W.setEmpty();
  if (claim.voxels == 0) {
    share.flesh.Reset(grid.first_voxel(), Eigen::Vector3i::Zero(), grid.voxel_mm());
    share.room = share.flesh;
    return;
  }
  share.box_W = BoxOf(claim.cells, grid);
  const Eigen::Vector3i margin = Eigen::Vector3i::Constant(kMargin);
  const Eigen::Vector3i last = grid.size() - Eigen::Vector3i::Ones();
  const Eigen::AlignedBox3i block((claim.cells.min() - margin).cwiseMax(0),
                                  (claim.cells.max() + margin).cwiseMin(last));
  CopyBlock(claim.grid, block, share.flesh);
  CopyBlock(grid, block, share.room);
}

}  // namespace mocap
