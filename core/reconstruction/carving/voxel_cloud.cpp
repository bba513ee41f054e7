#include "core/reconstruction/carving/voxel_cloud.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "core/kernels/cells.h"

namespace mocap {
namespace {

using CloudWord = std::uint64_t;

// A detached piece is kept if it is at least this share of the body and at most this far from it.
constexpr double kPieceShare = 0.005;
constexpr double kPieceReachMm = 150;

// Bits [begin, begin + count) of a row with an empty word on each side.
unsigned BitsOf(const CloudWord* row, int begin, int count) {
  // The shift rounds negative numbers down.
  const CloudWord* const word = row + (begin >> 6);
  const int shift = begin & 63;
  CloudWord bits = word[0] >> shift;
  if (shift > 64 - count) bits |= word[1] << (64 - shift);
  return static_cast<unsigned>(bits) & ((1u << count) - 1);
}

// Bits [begin, end) of the word that starts at bit 64 i.
CloudWord MaskOf(int i, int begin, int end) {
  CloudWord mask = ~CloudWord{0};
  if (begin > i * 64) mask <<= begin - i * 64;
  if (end < i * 64 + 64) mask &= ~CloudWord{0} >> (i * 64 + 64 - end);
  return mask;
}

// For each bit pattern: the number of set bits, and the sum of their positions.
constexpr int kMostBits = 7;
struct BitSums {
  int count = 0, places = 0;
};
constexpr auto kBitSums = [] {
  std::array<BitSums, 1 << kMostBits> sums{};
  for (unsigned bits = 0; bits < sums.size(); ++bits)
    for (int place = 0; place < kMostBits; ++place)
      if (bits >> place & 1) ++sums[bits].count, sums[bits].places += place;
  return sums;
}();

constexpr int kPlaces = kernels::kLinePoints;

}  // namespace

Vector3 VoxelCloud::Centroid() const {
  Vector3 sum = Vector3::Zero();
  for (const Voxel& voxel : voxels_) sum += voxel.center_W;
  return empty() ? sum : Vector3(sum / size());
}

int VoxelCloud::IndexAt(const Eigen::Vector3i& cell) const {
  if (!HoldsCell(bits_, cell)) return -1;
  const CloudWord* const row = RowOf(cell.y(), cell.z());
  const int word = cell.x() >> 6;
  int index = first_of_row_[static_cast<std::size_t>(cell.z()) * size_.y() + cell.y()];
  for (int i = 0; i < word; ++i) index += std::popcount(row[i]);
  return index + std::popcount(row[word] & ((CloudWord{1} << (cell.x() & 63)) - 1));
}

void VoxelCloud::Build(const VoxelGrid& grid, const VoxelGrid& room) {
  size_ = grid.size();
  origin_W_ = grid.origin_W();
  voxel_mm_ = grid.voxel_mm();
  words_per_row_ = grid.words_per_row() + 1;
  const std::ptrdiff_t rows = std::ptrdiff_t{size_.y() + 2 * kMargin} * (size_.z() + 2 * kMargin);
  bits_.assign(1 + rows * words_per_row_, 0);
  CopyPerson(grid);
  is_alone_ = &grid == &room;
  if (!is_alone_) AddOthers(grid, room);
  ListVoxels(grid);
}

bool VoxelCloud::IsNearPiece(const VoxelPieces::Run& run, int piece, int reach) const {
  const int first_j = std::max(run.j - reach, 0);
  const int last_j = std::min(run.j + reach, size_.y() - 1);
  for (int k = std::max(run.k - reach, 0); k <= std::min(run.k + reach, size_.z() - 1); ++k) {
    for (const VoxelPieces::Run& other : pieces_.RunsOf(first_j, last_j, k)) {
      const int gap = std::max(other.begin - run.end, run.begin - other.end) + 1;
      if (gap <= reach && other.piece == piece) return true;
    }
  }
  return false;
}

void VoxelCloud::CopyPerson(const VoxelGrid& grid) {
  pieces_.Find(grid);
  const std::vector<int>& sizes = pieces_.sizes();
  if (sizes.empty()) return;
  const int body = static_cast<int>(std::ranges::max_element(sizes) - sizes.begin());
  is_kept_.assign(sizes.size(), false);
  is_kept_[body] = true;
  const int reach = static_cast<int>(kPieceReachMm / voxel_mm_);
  for (const VoxelPieces::Run& run : pieces_.runs()) {
    if (is_kept_[run.piece] || sizes[run.piece] < kPieceShare * sizes[body]) continue;
    is_kept_[run.piece] = IsNearPiece(run, body, reach);
  }
  for (const VoxelPieces::Run& run : pieces_.runs()) {
    if (!is_kept_[run.piece]) continue;
    CloudWord* const row = &bits_[WordOf(run.j, run.k)];
    for (int word = run.begin / 64; word <= (run.end - 1) / 64; ++word)
      row[word] |= MaskOf(word, run.begin, run.end);
  }
}

void VoxelCloud::AddOthers(const VoxelGrid& grid, const VoxelGrid& room) {
  solid_bits_ = bits_;
  for (int k = 0; k < size_.z(); ++k) {
    for (int j = 0; j < size_.y(); ++j) {
      CloudWord* const solid = &solid_bits_[WordOf(j, k)];
      for (int i = 0; i < grid.words_per_row(); ++i)
        solid[i] |= room.row(j, k)[i] & ~grid.row(j, k)[i];
    }
  }
}

void VoxelCloud::ListVoxels(const VoxelGrid& grid) {
  voxels_.clear();
  surface_.clear();
  first_of_row_.clear();
  held_cells_.setEmpty();
  const std::ptrdiff_t above = WordOf(0, 1) - WordOf(0, 0);
  for (int k = 0; k < size_.z(); ++k) {
    for (int j = 0; j < size_.y(); ++j) {
      const CloudWord* const row = RowOf(j, k);
      const CloudWord* const solid = SolidRowOf(j, k);
      first_of_row_.push_back(size());
      for (int i = 0; i + 1 < words_per_row_; ++i) {
        const CloudWord* const here = solid + i;
        const CloudWord within = (here[0] << 1 | here[-1] >> 63) & (here[0] >> 1 | here[1] << 63) &
                                 here[words_per_row_] & here[-words_per_row_] & here[above] &
                                 here[-above];
        for (CloudWord bits = row[i]; bits != 0; bits &= bits - 1) {
          const int bit = std::countr_zero(bits);
          const int x = i * 64 + bit;
          const bool is_surface = (within >> bit & 1) == 0;
          if (is_surface) surface_.push_back(size());
          voxels_.push_back({grid.CenterOf(x, j, k), {x, j, k}, is_surface});
        }
      }
      if (size() == first_of_row_.back()) continue;
      held_cells_.extend(voxels_[first_of_row_.back()].cell);
      held_cells_.extend(voxels_.back().cell);
    }
  }
}

unsigned VoxelCloud::HeldFrom(const Places& places, int i, int end) const {
  const CloudWord* const first = RowOf(0, 0);
  const kernels::BitPitch pitch{static_cast<int>(RowOf(1, 0) - first),
                                static_cast<int>(RowOf(0, 1) - first)};
  const Vector3 &p = places.first, &step = places.step;
  kernels::LineCells cells;
  kernels::FindCells({{p.x(), p.y(), p.z()}, {step.x(), step.y(), step.z()}}, i, pitch, cells);
  unsigned held = 0;
  for (int place = 0; place < std::min(kPlaces, end - i); ++place)
    held |= static_cast<unsigned>(first[cells.word[place]] >> cells.bit[place] & 1) << place;
  return held;
}

VoxelCloud::Stretch VoxelCloud::StretchOf(const Places& places, int count) const {
  // One step more, because of rounding.
  double begin = 0, end = count;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = places.step[axis];
    if (step == 0) continue;
    const double a = (held_cells_.min()[axis] - places.first[axis]) / step;
    const double b = (held_cells_.max()[axis] + 1 - places.first[axis]) / step;
    begin = std::max(begin, std::min(a, b) - 1);
    end = std::min(end, std::max(a, b) + 2);
  }
  if (begin >= end) return {0, 0};
  return {static_cast<int>(begin), static_cast<int>(end)};
}

std::optional<int> VoxelCloud::FirstHeld(const Places& places, const Stretch& stretch) const {
  for (int i = stretch.begin; i < stretch.end; i += kPlaces)
    if (const unsigned held = HeldFrom(places, i, stretch.end)) return i + std::countr_zero(held);
  return std::nullopt;
}

int VoxelCloud::LastHeld(const Places& places, const Stretch& stretch) const {
  int begin = stretch.end;
  unsigned held = 0;
  while (held == 0) {
    const int end = begin;
    begin = std::max(stretch.begin, end - kPlaces);
    held = HeldFrom(places, begin, end);
  }
  return begin + static_cast<int>(std::bit_width(held)) - 1;
}

Vector3 VoxelCloud::NormalAt(const Voxel& voxel) const {
  // Wide enough that normals do not follow the steps of the grid.
  const int radius = std::clamp(static_cast<int>(std::lround(50 / voxel_mm_)), 1, kMargin);
  static_assert(2 * kMargin + 1 <= kMostBits);
  Eigen::Vector3i inward = Eigen::Vector3i::Zero();
  for (int dz = -radius; dz <= radius; ++dz) {
    for (int dy = -radius; dy <= radius; ++dy) {
      const CloudWord* const row = SolidRowOf(voxel.cell.y() + dy, voxel.cell.z() + dz);
      const unsigned bits = BitsOf(row, voxel.cell.x() - radius, 2 * radius + 1);
      const auto [count, places] = kBitSums[bits];
      inward += Eigen::Vector3i(places - radius * count, dy * count, dz * count);
    }
  }
  const double length = inward.cast<double>().norm();
  return length > 0 ? Vector3(-inward.cast<double>() / length) : Vector3::Zero();
}

}  // namespace mocap
