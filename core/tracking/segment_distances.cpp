#include "core/tracking/segment_distances.h"

#include <algorithm>
#include <array>

#include "core/lanes.h"

namespace mocap {
namespace {

// A batch of pairs, in columns.
struct Batch {
  static constexpr int kPairs = 64;
  using Column = std::array<double, kPairs>;
  using Columns = std::array<Column, 3>;

  Columns a, core, from, along;
  Column radius, taper;
  // Results.
  Columns place, segment_place;
  Column outside, share;
};

struct Vectors {
  Doubles x, y, z;
};
MOCAP_INLINE void LoadVectors(const Batch::Columns& columns, int i, Vectors& v) {
  LoadLanes(&columns[0][i], v.x), LoadLanes(&columns[1][i], v.y), LoadLanes(&columns[2][i], v.z);
}
MOCAP_INLINE void StoreVectors(const Vectors& v, int i, Batch::Columns& columns) {
  StoreLanes(v.x, &columns[0][i]), StoreLanes(v.y, &columns[1][i]), StoreLanes(v.z, &columns[2][i]);
}
MOCAP_INLINE void Subtract(const Vectors& a, const Vectors& b, Vectors& difference) {
  difference.x = a.x - b.x, difference.y = a.y - b.y, difference.z = a.z - b.z;
}
MOCAP_INLINE void GoAlong(const Vectors& from, const Doubles& share, const Vectors& way,
                          Vectors& place) {
  place.x = from.x + share * way.x, place.y = from.y + share * way.y;
  place.z = from.z + share * way.z;
}
MOCAP_INLINE void Choose(const decltype(Doubles{} < 0) & which, const Vectors& a, Vectors& b) {
  b.x = which ? a.x : b.x, b.y = which ? a.y : b.y, b.z = which ? a.z : b.z;
}
MOCAP_INLINE void Multiply(const Vectors& a, const Vectors& b, Doubles& product) {
  product = a.x * b.x + a.y * b.y + a.z * b.z;
}
MOCAP_INLINE void FindLength(const Vectors& from, const Vectors& to, Doubles& length) {
  Vectors way;
  Subtract(to, from, way);
  Multiply(way, way, length);
  TakeRoots(length);
}

// Like PosedCapsule::DistanceTo, but computes all branches for all pairs and then selects.
MOCAP_INLINE void FindFour(int i, Batch& batch) {
  constexpr double kLeast = 1e-9;
  Vectors a, core, from, along, between;
  Doubles radius, taper;
  LoadVectors(batch.a, i, a), LoadVectors(batch.core, i, core);
  LoadVectors(batch.from, i, from), LoadVectors(batch.along, i, along);
  LoadLanes(&batch.radius[i], radius), LoadLanes(&batch.taper[i], taper);
  Subtract(a, from, between);
  Doubles length_sq, along_sq, dot, c, f;
  Multiply(core, core, length_sq), Multiply(along, along, along_sq);
  Multiply(core, along, dot), Multiply(core, between, c), Multiply(along, between, f);
  const Doubles core_sq = length_sq < kLeast ? Doubles{} + kLeast : length_sq;
  along_sq = along_sq < kLeast ? Doubles{} + kLeast : along_sq;
  const Doubles slant = core_sq * along_sq - dot * dot;
  Doubles first = (dot * f - c * along_sq) / slant;
  first = Clamped(first, 0.0, 1.0);
  first = slant > kLeast * core_sq * along_sq ? first : Doubles{} + 0.5;
  Doubles on_segment = (dot * first + f) / along_sq;
  on_segment = Clamped(on_segment, 0.0, 1.0);
  Doubles share = (dot * on_segment - c) / core_sq;
  share = Clamped(share, 0.0, 1.0);
  Vectors place, segment_place;
  GoAlong(a, share, core, place), GoAlong(from, on_segment, along, segment_place);
  Doubles apart;
  FindLength(place, segment_place, apart);

  const auto slides =
      (share > 0) & (share < 1) & (on_segment > 0) & (on_segment < 1) & (taper != 0);
  // Contacts that are not edges never slide, and they are adjacent.
  if ((slides[0] | slides[1] | slides[2] | slides[3]) != 0) {
    const Doubles slope = taper * dot / core_sq;
    const Doubles curvature = slant / core_sq / (apart < 1 ? Doubles{} + 1 : apart);
    Doubles slide = slope / curvature;
    slide = Clamped(slide, -0.5, 0.5);
    Doubles slid = on_segment + slide;
    slid = Clamped(slid, 0.0, 1.0);
    Vectors slid_place, from_a, slid_core;
    GoAlong(from, slid, along, slid_place);
    Subtract(slid_place, a, from_a);
    Doubles slid_share;
    Multiply(from_a, core, slid_share);
    slid_share /= core_sq;
    slid_share = Clamped(slid_share, 0.0, 1.0);
    GoAlong(a, slid_share, core, slid_core);
    Doubles slid_apart;
    FindLength(slid_core, slid_place, slid_apart);
    Choose(slides, slid_core, place), Choose(slides, slid_place, segment_place);
    share = slides ? slid_share : share;
    apart = slides ? slid_apart : apart;
  }
  StoreVectors(place, i, batch.place), StoreVectors(segment_place, i, batch.segment_place);
  StoreLanes(apart - (radius + share * taper), &batch.outside[i]);
  StoreLanes(share, &batch.share[i]);
}

MOCAP_VECTORIZED
void FindAll(int count, Batch& batch) {
  for (int i = 0; i < count; i += kDoubles) FindFour(i, batch);
}

void SetColumn(const Vector3& v, int i, Batch::Columns& columns) {
  for (int axis = 0; axis < 3; ++axis) columns[axis][i] = v[axis];
}
Vector3 ColumnOf(const Batch::Columns& columns, int i) {
  return {columns[0][i], columns[1][i], columns[2][i]};
}

void Fill(const CapsuleAndSegment& pair, int i, Batch& batch) {
  const PosedCapsule& capsule = *pair.capsule;
  SetColumn(capsule.a_W, i, batch.a);
  SetColumn(capsule.b_W - capsule.a_W, i, batch.core);
  SetColumn(*pair.from_W, i, batch.from);
  SetColumn(*pair.to_W - *pair.from_W, i, batch.along);
  batch.radius[i] = capsule.radius_a_mm;
  batch.taper[i] = capsule.radius_b_mm - capsule.radius_a_mm;
}

}  // namespace

void FindDistances(std::span<const CapsuleAndSegment> pairs) {
  Batch batch;
  for (std::size_t begin = 0; begin < pairs.size(); begin += Batch::kPairs) {
    const int count = static_cast<int>(std::min<std::size_t>(Batch::kPairs, pairs.size() - begin));
    // The last pair is repeated to fill the vectors.
    for (int i = 0; i < (count + kDoubles - 1) / kDoubles * kDoubles; ++i)
      Fill(pairs[begin + std::min(i, count - 1)], i, batch);
    FindAll(count, batch);
    for (int i = 0; i < count; ++i) {
      *pairs[begin + i].distance = {ColumnOf(batch.place, i), ColumnOf(batch.segment_place, i),
                                    batch.outside[i], batch.share[i]};
    }
  }
}

}  // namespace mocap
