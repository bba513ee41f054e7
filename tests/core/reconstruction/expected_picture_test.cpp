#include "core/reconstruction/expected_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocap {
namespace {

TEST(ExpectedPicture, WeightsAreThoseOfHorprasert) {
  ExpectedPicture picture(1, 1);
  picture.SetPixel(0, {100, 80, 60}, {2, 4, 3}, 0);
  picture.Weigh(0, 0, 1);
  EXPECT_NEAR(picture.inverse_sigma[0][0], 1 / 2.0, 1e-6);
  EXPECT_NEAR(picture.inverse_sigma[1][0], 1 / 4.0, 1e-6);
  EXPECT_NEAR(picture.inverse_sigma[2][0], 1 / 3.0, 1e-6);
  EXPECT_NEAR(picture.inverse_square[0], 1 / 3300.0, 1e-9);
  EXPECT_NEAR(picture.alpha_weight[0], std::sqrt(3300.0), 1e-3);
}

TEST(ExpectedPicture, BrightnessVariesAtLeastAsItWasMeasured) {
  ExpectedPicture picture(1, 1);
  picture.SetPixel(0, {100, 100, 100}, {2, 2, 2}, 0.05f);
  picture.Weigh(0, 0, 1);
  EXPECT_NEAR(picture.alpha_weight[0], 20, 1e-3);
}

TEST(ExpectedPicture, ShiftWidensSigmaWhereThePictureIsSteep) {
  ExpectedPicture picture(2, 1);
  for (const std::size_t i : {0, 1}) picture.SetPixel(i, {100, 100, 100}, {2, 2, 2}, 0);
  picture.slope[1] = 20;
  picture.Weigh(0.3f, 0, 2);
  EXPECT_NEAR(picture.inverse_sigma[2][0], 1 / 2.0, 1e-5);
  EXPECT_NEAR(picture.inverse_sigma[2][1], 1 / std::hypot(2, 6), 1e-5);
}

TEST(ExpectedPicture, BlackHasADirectionToo) {
  ExpectedPicture picture(1, 1);
  picture.SetPixel(0, {0, 0, 0}, {2, 2, 2}, 0);
  EXPECT_EQ(picture.mean[0][0], 1);
}

}  // namespace
}  // namespace mocap
