#include "tools/calibration/lens_parameters.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(LensParameters, ARationalLensKeepsItsLastThreeCoefficientsWhenItIsRefined) {
  OpenCvLens lens;
  lens.K << 500, 0, 320, 0, 501, 240, 0, 0, 1;
  lens.distortion = {1.5, -0.8, 0.001, -0.0005, 0.2, 1.9, -0.6, 0.1};
  std::vector<double> parameters = LensParameters(lens);
  ASSERT_EQ(parameters.size(), 9u);
  for (double& parameter : parameters) parameter += 1;
  const auto changed = std::get<OpenCvLens>(WithParameters(lens, parameters.data()));
  EXPECT_EQ(changed.K(1, 1), 502);
  EXPECT_EQ(changed.distortion[4], 0.2 + 1);
  for (std::size_t i = 5; i < 8; ++i) EXPECT_EQ(changed.distortion[i], lens.distortion[i]);
}

}  // namespace
}  // namespace mocap
