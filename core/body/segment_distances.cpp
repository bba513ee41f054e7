#include "core/body/segment_distances.h"

#include <algorithm>
#include <array>

#include "core/kernels/segments.h"

namespace mocap {
namespace {

using Batch = kernels::SegmentBatch;

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
    for (int i = 0; i < (count + Batch::kStep - 1) / Batch::kStep * Batch::kStep; ++i)
      Fill(pairs[begin + std::min(i, count - 1)], i, batch);
    kernels::FindSegmentDistances(count, batch);
    for (int i = 0; i < count; ++i) {
      *pairs[begin + i].distance = {ColumnOf(batch.place, i), ColumnOf(batch.segment_place, i),
                                    batch.outside[i], batch.share[i]};
    }
  }
}

}  // namespace mocap
