#include "core/kernels/nearest.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/nearest.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

int FindNearest(const double* xs, const double* ys, const double* zs, int count,
                const std::array<double, 3>& place) {
  constexpr hn::CappedTag<double, kPointStep> d;
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  const auto px = hn::Set(d, place[0]), py = hn::Set(d, place[1]), pz = hn::Set(d, place[2]);
  auto least_sq = hn::Set(d, std::numeric_limits<double>::infinity());
  auto nearest = hn::Zero(d), index = hn::Iota(d, 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); i += kLanes) {
    const auto x = hn::LoadU(d, xs + i) - px, y = hn::LoadU(d, ys + i) - py;
    const auto z = hn::LoadU(d, zs + i) - pz;
    const auto distance_sq = x * x + y * y + z * z;
    const auto is_nearer = hn::Lt(distance_sq, least_sq);
    least_sq = hn::IfThenElse(is_nearer, distance_sq, least_sq);
    nearest = hn::IfThenElse(is_nearer, index, nearest);
    index = index + hn::Set(d, kLanes);
  }
  HWY_ALIGN std::array<double, kLanes> distances, indices;
  hn::Store(least_sq, d, distances.data()), hn::Store(nearest, d, indices.data());
  std::size_t best = 0;
  for (std::size_t lane = 1; lane < kLanes; ++lane) {
    const bool is_nearer = distances[lane] < distances[best] ||
                           (distances[lane] == distances[best] && indices[lane] < indices[best]);
    if (is_nearer) best = lane;
  }
  return static_cast<int>(indices[best]);
}

constexpr int kRays = RayBlock::kRays;
constexpr std::size_t kHalf = kRays / 2;
// Tie-break between equally near rays: even places first.
constexpr std::array<std::uint32_t, kHalf> kOrder = {7, 3, 5, 1, 6, 2, 4, 0};
constexpr std::array<int, kHalf> kPlaceOf = {7, 3, 5, 1, 6, 2, 4, 0};

using D = FloatsUpTo<kHalf>;
constexpr D kFloats;
constexpr IntsFor<D> kInts;

// The farthest ray per lane so far, with the index of its block.
struct Farthest {
  hn::Vec<D> along;
  hn::Vec<IntsFor<D>> block;

  HWY_INLINE void Try(hn::Vec<D> other_along, hn::Vec<IntsFor<D>> other_block) {
    const auto is_farther = hn::Gt(other_along, along);
    along = hn::IfThenElse(is_farther, other_along, along);
    block = hn::IfThenElse(hn::RebindMask(kInts, is_farther), other_block, block);
  }
};

HWY_INLINE hn::Vec<D> Along(const RayBlock& rays, std::size_t k,
                            const std::array<float, 3>& sight) {
  return hn::LoadU(kFloats, &rays.x[k]) * hn::Set(kFloats, sight[0]) +
         hn::LoadU(kFloats, &rays.y[k]) * hn::Set(kFloats, sight[1]) +
         hn::LoadU(kFloats, &rays.z[k]) * hn::Set(kFloats, sight[2]);
}

// Compares the lower and upper halves of blocks separately, and then with each other: the first ray
// of equally far ones wins in each.
int FindFarthest(const RayBlock* blocks, int count, const std::array<float, 3>& sight) {
  alignas(32) std::array<float, kHalf> along;
  alignas(32) std::array<std::int32_t, kHalf> first;
  for (std::size_t k = 0; k < kHalf; k += hn::MaxLanes(kFloats)) {
    Farthest low = {hn::Zero(kFloats), hn::Zero(kInts)}, high = low;
    for (int i = 0; i < count; ++i) {
      low.Try(Along(blocks[i], k, sight), hn::Set(kInts, i * kRays));
      high.Try(Along(blocks[i], k + kHalf, sight),
               hn::Set(kInts, i * kRays + static_cast<int>(kHalf)));
    }
    low.Try(high.along, high.block);
    hn::StoreU(low.along, kFloats, &along[k]), hn::StoreU(low.block, kInts, &first[k]);
  }
  // Non-negative floats sort like their bits; the lower half of the key holds the place.
  std::uint64_t best = 0;
  for (std::size_t place = 0; place < kHalf; ++place) {
    const auto bits = std::bit_cast<std::uint32_t>(along[place]);
    best = std::max(best, std::uint64_t{bits} << 32 | kOrder[place]);
  }
  if (best >> 32 == 0) return -1;
  const int place = kPlaceOf[best & (kHalf - 1)];
  return first[place] + place;
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(FindNearest);
int FindNearestPoint(const double* x, const double* y, const double* z, int count,
                     const std::array<double, 3>& place) {
  return HWY_DYNAMIC_DISPATCH(FindNearest)(x, y, z, count, place);
}

void NearestPoint::Add(const std::array<double, 3>& point) {
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    // After the last point there are some at infinite distance.
    if (count_ % kPointStep == 0) {
      axes_[axis].resize(count_);
      axes_[axis].resize(count_ + kPointStep, std::numeric_limits<double>::infinity());
    }
    axes_[axis][count_] = point[axis];
  }
  ++count_;
}

std::array<double, 3> NearestPoint::To(const std::array<double, 3>& place) const {
  const auto i = static_cast<std::size_t>(FindNearestPoint(
      axes_[0].data(), axes_[1].data(), axes_[2].data(), static_cast<int>(count_), place));
  return {axes_[0][i], axes_[1][i], axes_[2][i]};
}

HWY_EXPORT(FindFarthest);
int FindFarthestRay(const RayBlock* blocks, int count, const std::array<float, 3>& sight) {
  return HWY_DYNAMIC_DISPATCH(FindFarthest)(blocks, count, sight);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
