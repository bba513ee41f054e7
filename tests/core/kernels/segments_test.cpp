#include "core/kernels/segments.h"

#include "core/kernels/segments_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

TEST(SegmentKernels, DistancesAreFoundPairByPair) {
  for (const int count : {1, 5, 8, 64}) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      Numbers numbers(seed);
      SegmentBatch batch{};
      const auto fill = [&](SegmentBatch::Column& column, double low, double high) {
        std::ranges::copy(numbers.Doubles(SegmentBatch::kPairs, low, high), column.begin());
      };
      for (int axis = 0; axis < 3; ++axis) {
        fill(batch.a[axis], -100, 100), fill(batch.core[axis], -200, 200);
        fill(batch.from[axis], -100, 100), fill(batch.along[axis], -90, 90);
        // Points, balls and parallels.
        for (std::size_t i = 0; i < SegmentBatch::kPairs; i += 3) {
          if (seed % 4 == 1) batch.along[axis][i] = 0;
          if (seed % 4 == 2) batch.core[axis][i] = 0;
          if (seed % 4 == 3) batch.along[axis][i] = 0.5 * batch.core[axis][i];
        }
      }
      fill(batch.radius, 20, 90), fill(batch.taper, -40, 40);
      if (seed % 2 == 0) batch.taper.fill(0);
      const auto numbers_of = [&](const SegmentBatch& found) {
        std::vector<double> results;
        for (int i = 0; i < count; ++i) {
          for (int axis = 0; axis < 3; ++axis) {
            results.push_back(found.place[axis][i]);
            results.push_back(found.segment_place[axis][i]);
          }
          results.push_back(found.outside[i]), results.push_back(found.share[i]);
        }
        return results;
      };
      ExpectSameBits(
          [&] {
            SegmentBatch found = batch;
            for (int i = 0; i < count; ++i) reference::FindSegmentDistance(i, found);
            return numbers_of(found);
          },
          [&] {
            SegmentBatch found = batch;
            FindSegmentDistances(count, found);
            return numbers_of(found);
          });
    }
  }
}

}  // namespace
}  // namespace mocap::kernels
