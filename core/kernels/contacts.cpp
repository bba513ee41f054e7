#include "core/kernels/contacts.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/contacts.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

using D = FloatsUpTo<ContactBlock::kContacts>;
constexpr D kFloats;
constexpr IntsFor<D> kInts;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
constexpr std::size_t kContacts = ContactBlock::kContacts;
using Floats = hn::Vec<D>;

HWY_INLINE Floats All(float number) { return hn::Set(kFloats, number); }
HWY_INLINE Floats Load(const float* from) { return hn::LoadU(kFloats, from); }

struct Vectors {
  Floats x, y, z;
};
HWY_INLINE Vectors Load(const std::array<ContactBlock::Column, 3>& columns, std::size_t k) {
  return {Load(&columns[0][k]), Load(&columns[1][k]), Load(&columns[2][k])};
}
HWY_INLINE Floats Dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Closest points of two segments (Ericson 2005, §5.1.9), without branches. For contacts from the
// k-th on.
HWY_INLINE void TryCapsule(const ContactBlock& block, std::size_t k, const SlimCapsule& capsule,
                           int index, BestCapsules& best) {
  const Vectors core = {All(capsule.core[0]), All(capsule.core[1]), All(capsule.core[2])};
  const Vectors along = Load(block.along, k), from = Load(block.from, k);
  const Floats along_sq = Load(&block.along_sq[k]);
  const Vectors between = {All(capsule.a[0]) - from.x, All(capsule.a[1]) - from.y,
                           All(capsule.a[2]) - from.z};
  const Floats dot = Dot(core, along), c = Dot(core, between), f = Dot(along, between);
  const Floats slant = All(capsule.core_sq) * along_sq - dot * dot;
  const Floats least = All(kParallel * capsule.core_sq) * along_sq;
  const Floats first = Clamped(
      kFloats, (dot * f - c * along_sq) / hn::IfThenElse(hn::Gt(slant, least), slant, least), 0.0f,
      1.0f);
  const Floats on_segment =
      Clamped(kFloats, (dot * first + f) * Load(&block.per_along_sq[k]), 0.0f, 1.0f);
  const Floats share =
      Clamped(kFloats, (dot * on_segment - c) * All(capsule.per_core_sq), 0.0f, 1.0f);
  const Vectors way = {on_segment * along.x - between.x - share * core.x,
                       on_segment * along.y - between.y - share * core.y,
                       on_segment * along.z - between.z - share * core.z};
  const Floats length = hn::Sqrt(Dot(way, way));
  const Floats apart = hn::Abs(length - All(capsule.radius) - share * All(capsule.taper));
  const Floats facing = Dot(Load(block.outward, k), way) / (length + All(1));
  const Floats value = apart + All(kSquare_mm) * (All(1) - facing);
  const Floats mismatch = Load(&best.mismatch[k]);
  const auto capsules = hn::LoadU(kInts, &best.capsule[k]);
  const auto is_lower = hn::RebindMask(kFloats, hn::Lt(hn::Set(kInts, index), capsules));
  const auto is_better =
      hn::Or(hn::Lt(value, mismatch), hn::And(hn::Eq(value, mismatch), is_lower));
  hn::StoreU(hn::IfThenElse(hn::RebindMask(kInts, is_better), hn::Set(kInts, index), capsules),
             kInts, &best.capsule[k]);
  hn::StoreU(hn::IfThenElse(is_better, apart, Load(&best.distance[k])), kFloats, &best.distance[k]);
  hn::StoreU(hn::IfThenElse(is_better, value, mismatch), kFloats, &best.mismatch[k]);
}

void TryAll(const CapsuleTrial* trials, int count, const ContactBlock* blocks,
            const SlimCapsule* capsules, BestCapsules* bests) {
  for (int i = 0; i < count; ++i) {
    const auto [block, capsule] = trials[i];
    for (std::size_t k = 0; k < kContacts; k += kLanes)
      TryCapsule(blocks[block], k, capsules[capsule], capsule, bests[block]);
  }
}

// In a tree, so that no comparison waits for the previous one.
HWY_INLINE float WorstOf(const ContactBlock::Column& a) {
  return std::max(std::max(std::max(a[0], a[1]), std::max(a[2], a[3])),
                  std::max(std::max(a[4], a[5]), std::max(a[6], a[7])));
}

// The capsules whose box is within reach of the block's.
HWY_INLINE std::uint32_t CapsulesWithin(const ContactBlock& block, const CapsuleBoxes& boxes,
                                        float reach_mm) {
  std::uint32_t within = 0;
  for (std::size_t k = 0; k < kMostCapsules; k += kLanes) {
    auto is_within = hn::Le(Load(&boxes.low[0][k]), All(block.high[0] + reach_mm));
    is_within = hn::And(is_within, hn::Ge(Load(&boxes.high[0][k]), All(block.low[0] - reach_mm)));
    for (int axis = 1; axis < 3; ++axis) {
      is_within = hn::And(
          is_within, hn::And(hn::Le(Load(&boxes.low[axis][k]), All(block.high[axis] + reach_mm)),
                             hn::Ge(Load(&boxes.high[axis][k]), All(block.low[axis] - reach_mm))));
    }
    within |= BitsOf(kFloats, is_within) << k;
  }
  return within;
}

// Whether the ball around a capsule is near enough for a better match of one of a block's contacts.
HWY_INLINE bool IsInReach(const ContactBlock& block, const SlimCapsule& capsule,
                          const BestCapsules& best) {
  bool is_any = false;
  for (std::size_t k = 0; k < kContacts; k += kLanes) {
    const Vectors along = Load(block.along, k), from = Load(block.from, k);
    Vectors way = {All(capsule.middle[0]) - from.x, All(capsule.middle[1]) - from.y,
                   All(capsule.middle[2]) - from.z};
    const Floats on_segment =
        Clamped(kFloats, Dot(way, along) * Load(&block.per_along_sq[k]), 0.0f, 1.0f);
    way = {way.x - on_segment * along.x, way.y - on_segment * along.y,
           way.z - on_segment * along.z};
    const Floats reach = Load(&best.mismatch[k]) + All(capsule.reach + kBoxRounding_mm);
    is_any |= BitsOf(kFloats, hn::Le(Dot(way, way), reach * reach)) != 0;
  }
  return is_any;
}

int ListNear(int begin, int end, const ContactBlock* blocks, const SlimCapsule* capsules,
             const CapsuleBoxes& boxes, std::uint32_t all, const BestCapsules* bests,
             CapsuleTrial* trials) {
  int count = 0;
  for (int b = begin; b < end; ++b) {
    std::uint32_t some =
        CapsulesWithin(blocks[b], boxes, WorstOf(bests[b].mismatch) + kBoxRounding_mm);
    for (some &= all & ~blocks[b].favourites; some != 0; some &= some - 1) {
      trials[count] = {b, std::countr_zero(some)};
      count += IsInReach(blocks[b], capsules[trials[count].capsule], bests[b]);
    }
  }
  return count;
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(TryAll);
void TryCapsules(const CapsuleTrial* trials, int count, const ContactBlock* blocks,
                 const SlimCapsule* capsules, BestCapsules* bests) {
  HWY_DYNAMIC_DISPATCH(TryAll)(trials, count, blocks, capsules, bests);
}

HWY_EXPORT(ListNear);
int ListNearCapsules(int begin, int end, const ContactBlock* blocks, const SlimCapsule* capsules,
                     const CapsuleBoxes& boxes, std::uint32_t all, const BestCapsules* bests,
                     CapsuleTrial* trials) {
  return HWY_DYNAMIC_DISPATCH(ListNear)(begin, end, blocks, capsules, boxes, all, bests, trials);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
