#include "tools/accuracy/carving_trial.h"

#include <gtest/gtest.h>

#include "core/reconstruction/carving/miss_rates.h"

namespace mocap {
namespace {

TEST(CarvingTrial, OneMoreCameraCarvesAsMissRatesExpect) {
  for (const int others : {5, 8}) {
    const double share = ShareCarvedByOneMore(others + 1);
    EXPECT_GT(share, 0.6 * CarvedByOneMore(others)) << others;
    EXPECT_LT(share, 1.4 * CarvedByOneMore(others)) << others;
  }
}

}  // namespace
}  // namespace mocap
