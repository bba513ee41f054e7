#include "core/reconstruction/background/expected_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace mocap {
namespace {

TEST(ExpectedPicture, WeightsAreThoseOfHorprasert) {
  ExpectedPicture picture(1, 1);
  picture.SetPixel(0, {100, 80, 60}, {2, 4, 3});
  picture.Weigh(0, 0, 0, 1);
  const std::array sigma = {2.0, 4.0, 3.0};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(picture.MeanAt(0, 0, c), 100 - 20 * c, WeighedPixels::kMeanUnit / 2);
    EXPECT_NEAR(picture.InverseSigmaAt(0, 0, c), 1 / sigma[c],
                0.6 * WeighedPixels::kInverseSigmaUnit);
  }
  EXPECT_NEAR(picture.AlphaWeightAt(0, 0), std::sqrt(3300.0),
              0.6 * WeighedPixels::kAlphaWeightUnit);
}

TEST(ExpectedPicture, ShiftWidensSigmaWhereThePictureIsSteep) {
  ExpectedPicture picture(2, 1);
  for (const std::size_t i : {0, 1}) picture.SetPixel(i, {100, 100, 100}, {2, 2, 2});
  picture.slope[1] = 20;
  picture.Weigh(0.3f, 0, 0, 2);
  EXPECT_NEAR(picture.InverseSigmaAt(0, 0, 2), 1 / 2.0, 1e-5);
  EXPECT_NEAR(picture.InverseSigmaAt(1, 0, 2), 1 / std::hypot(2, 6), 1e-5);
}

TEST(ExpectedPicture, BlackHasADirectionToo) {
  ExpectedPicture picture(1, 1);
  picture.SetPixel(0, {0, 0, 0}, {2, 2, 2});
  EXPECT_EQ(picture.mean[0][0], 1);
}

}  // namespace
}  // namespace mocap
