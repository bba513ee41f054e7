#include "core/kernels/segments.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/segments.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

using D = hn::CappedTag<double, SegmentBatch::kStep>;
constexpr D kDoubles;
constexpr std::size_t kLanes = hn::MaxLanes(kDoubles);
using Doubles = hn::Vec<D>;

HWY_INLINE Doubles All(double number) { return hn::Set(kDoubles, number); }

struct Vectors {
  Doubles x, y, z;
};
HWY_INLINE Vectors Load(const SegmentBatch::Columns& columns, std::size_t i) {
  return {hn::LoadU(kDoubles, &columns[0][i]), hn::LoadU(kDoubles, &columns[1][i]),
          hn::LoadU(kDoubles, &columns[2][i])};
}
HWY_INLINE void Store(const Vectors& v, std::size_t i, SegmentBatch::Columns& columns) {
  hn::StoreU(v.x, kDoubles, &columns[0][i]);
  hn::StoreU(v.y, kDoubles, &columns[1][i]);
  hn::StoreU(v.z, kDoubles, &columns[2][i]);
}
HWY_INLINE Vectors Difference(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vectors GoAlong(const Vectors& from, Doubles share, const Vectors& way) {
  return {from.x + share * way.x, from.y + share * way.y, from.z + share * way.z};
}
HWY_INLINE Vectors Choose(hn::Mask<D> which, const Vectors& a, const Vectors& b) {
  return {hn::IfThenElse(which, a.x, b.x), hn::IfThenElse(which, a.y, b.y),
          hn::IfThenElse(which, a.z, b.z)};
}
HWY_INLINE Doubles Dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE Doubles Distance(const Vectors& a, const Vectors& b) {
  const Vectors way = Difference(b, a);
  return hn::Sqrt(Dot(way, way));
}
HWY_INLINE Doubles Share(Doubles share) { return Clamped(kDoubles, share, 0.0, 1.0); }

// Like PosedCapsule::DistanceTo, but computes all branches for all pairs and then selects.
HWY_INLINE void FindSome(std::size_t i, SegmentBatch& batch) {
  constexpr double kLeast = 1e-9;
  const Doubles zero = hn::Zero(kDoubles), one = All(1);
  const Vectors a = Load(batch.a, i), core = Load(batch.core, i);
  const Vectors from = Load(batch.from, i), along = Load(batch.along, i);
  const Doubles radius = hn::LoadU(kDoubles, &batch.radius[i]);
  const Doubles taper = hn::LoadU(kDoubles, &batch.taper[i]);
  const Vectors between = Difference(a, from);
  const Doubles core_sq = Larger(Dot(core, core), All(kLeast));
  const Doubles along_sq = Larger(Dot(along, along), All(kLeast));
  const Doubles dot = Dot(core, along), c = Dot(core, between), f = Dot(along, between);
  const Doubles slant = core_sq * along_sq - dot * dot;
  const Doubles first = hn::IfThenElse(hn::Gt(slant, All(kLeast) * core_sq * along_sq),
                                       Share((dot * f - c * along_sq) / slant), All(0.5));
  const Doubles on_segment = Share((dot * first + f) / along_sq);
  Doubles share = Share((dot * on_segment - c) / core_sq);
  Vectors place = GoAlong(a, share, core), segment_place = GoAlong(from, on_segment, along);
  Doubles apart = Distance(place, segment_place);

  const auto slides = hn::And(hn::And(hn::And(hn::Gt(share, zero), hn::Lt(share, one)),
                                      hn::And(hn::Gt(on_segment, zero), hn::Lt(on_segment, one))),
                              hn::Ne(taper, zero));
  // Contacts that are not edges never slide, and they are adjacent.
  if (BitsOf(kDoubles, slides) != 0) {
    const Doubles slope = taper * dot / core_sq;
    const Doubles curvature = slant / core_sq / Larger(apart, one);
    const Doubles slide = Clamped(kDoubles, slope / curvature, -0.5, 0.5);
    const Vectors slid_place = GoAlong(from, Share(on_segment + slide), along);
    const Doubles slid_share = Share(Dot(Difference(slid_place, a), core) / core_sq);
    const Vectors slid_core = GoAlong(a, slid_share, core);
    const Doubles slid_apart = Distance(slid_core, slid_place);
    place = Choose(slides, slid_core, place);
    segment_place = Choose(slides, slid_place, segment_place);
    share = hn::IfThenElse(slides, slid_share, share);
    apart = hn::IfThenElse(slides, slid_apart, apart);
  }
  Store(place, i, batch.place), Store(segment_place, i, batch.segment_place);
  hn::StoreU(apart - (radius + share * taper), kDoubles, &batch.outside[i]);
  hn::StoreU(share, kDoubles, &batch.share[i]);
}

void FindAll(int count, SegmentBatch& batch) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); i += kLanes) FindSome(i, batch);
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(FindAll);
void FindSegmentDistances(int count, SegmentBatch& batch) {
  HWY_DYNAMIC_DISPATCH(FindAll)(count, batch);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
