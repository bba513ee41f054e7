#include "core/evaluation/jitter.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

std::vector<ScoredPoints> Motion(int frames, auto x_mm) {
  std::vector<ScoredPoints> run;
  for (int i = 0; i < frames; ++i) {
    run.push_back(ScoredPoints::Zero());
    run.back().row(0).setConstant(x_mm(i));
  }
  return run;
}

TEST(Jitter, IsNoneOfAConstantAcceleration) {
  const std::vector<std::vector<ScoredPoints>> runs = {
      Motion(12, [](int i) { return 5.0 + 3 * i + 2 * i * i; })};
  EXPECT_NEAR(*MeanThirdDifference_mm(runs), 0, 1e-9);
}

TEST(Jitter, IsTheThirdDifference) {
  const std::vector<std::vector<ScoredPoints>> runs = {
      Motion(12, [](int i) { return i % 2 == 0 ? 1.0 : -1.0; })};
  EXPECT_NEAR(*MeanThirdDifference_mm(runs), 8, 1e-9);
}

TEST(Jitter, IsNotKnownOfShortRuns) {
  const std::vector<std::vector<ScoredPoints>> runs(5, Motion(3, [](int i) { return 100.0 * i; }));
  EXPECT_FALSE(MeanThirdDifference_mm(runs));
}

}  // namespace
}  // namespace mocap
