// §4: the person as voxels.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// A block of cubic voxels, one bit each; rows run along x. Voxel (i, j, k) spans origin_W +
/// voxel_mm * [i..i+1, …].
///
/// Origins are integer multiples of the voxel size. Therefore a place falls into the same voxel in
/// every frame.
class VoxelGrid {
 public:
  /// Sets the extent and clears every voxel; keeps its memory.
  void Reset(const Eigen::Vector3i& first_voxel, const Eigen::Vector3i& size, double voxel_mm) {
    first_ = first_voxel;
    size_ = size;
    voxel_mm_ = voxel_mm;
    words_per_row_ = (size.x() + 63) / 64;
    const std::size_t words = static_cast<std::size_t>(words_per_row_) * size.y() * size.z();
    // A person who moves soon needs more.
    if (words > words_.capacity()) words_.reserve(std::bit_ceil(words));
    words_.assign(words, 0);
  }

  /// Frees the memory; there are no voxels then.
  void Release() {
    size_ = Eigen::Vector3i::Zero();
    words_per_row_ = 0;
    std::vector<std::uint64_t>().swap(words_);
  }
  /// Size of the memory that it keeps.
  std::size_t capacity_bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

  double voxel_mm() const { return voxel_mm_; }
  const Eigen::Vector3i& size() const { return size_; }
  /// Index of the first voxel, counted from the world's origin.
  const Eigen::Vector3i& first_voxel() const { return first_; }
  Vector3 origin_W() const { return first_.cast<double>() * voxel_mm_; }
  /// The corner opposite to origin_W().
  Vector3 end_W() const { return (first_ + size_).cast<double>() * voxel_mm_; }
  Vector3 CenterOf(int i, int j, int k) const {
    return (first_ + Eigen::Vector3i(i, j, k)).cast<double>() * voxel_mm_ +
           Vector3::Constant(voxel_mm_ / 2);
  }
  bool Contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size_.x() && j < size_.y() && k < size_.z();
  }
  bool Test(int i, int j, int k) const { return row(j, k)[i >> 6] >> (i & 63) & 1; }
  /// Whether a voxel and its six neighbours are set. @pre  the grid contains it.
  bool IsEnclosed(int i, int j, int k) const {
    const auto is_set = [this](int x, int y, int z) { return Contains(x, y, z) && Test(x, y, z); };
    return Test(i, j, k) && is_set(i - 1, j, k) && is_set(i + 1, j, k) && is_set(i, j - 1, k) &&
           is_set(i, j + 1, k) && is_set(i, j, k - 1) && is_set(i, j, k + 1);
  }
  void Set(int i, int j, int k) { row(j, k)[i >> 6] |= std::uint64_t{1} << (i & 63); }
  void Clear(int i, int j, int k) { row(j, k)[i >> 6] &= ~(std::uint64_t{1} << (i & 63)); }
  int words_per_row() const { return words_per_row_; }
  std::uint64_t* row(int j, int k) {
    return words_.data() + (static_cast<std::size_t>(k) * size_.y() + j) * words_per_row_;
  }
  const std::uint64_t* row(int j, int k) const {
    return words_.data() + (static_cast<std::size_t>(k) * size_.y() + j) * words_per_row_;
  }
  const std::vector<std::uint64_t>& words() const { return words_; }
  /// Number of voxels that are set.
  std::int64_t Count() const {
    std::int64_t count = 0;
    for (const std::uint64_t word : words_) count += std::popcount(word);
    return count;
  }

 private:
  Eigen::Vector3i first_ = Eigen::Vector3i::Zero();
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  double voxel_mm_ = 0;
  int words_per_row_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace mocap
