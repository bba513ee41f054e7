#include "daemon/messages/reduced_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mocap {
namespace {

using ::testing::ElementsAre;

TEST(ReducedPicture, TheLeastFactorThatFitsIsTaken) {
  EXPECT_EQ(ReductionFor(320, 400), 1);
  EXPECT_EQ(ReductionFor(400, 400), 1);
  EXPECT_EQ(ReductionFor(644, 400), 2);
  EXPECT_EQ(ReductionFor(1920, 400), 5);
}

TEST(ReducedPicture, EachPixelIsTheMeanOfItsSquare) {
  Image<Bgr> picture(5, 2);
  picture(0, 0) = {8, 0, 0};
  picture(1, 1) = {0, 80, 4};
  picture(4, 1) = {255, 255, 255};
  Image<Bgr> reduced;
  ReducePicture(picture.view(), 2, reduced);
  EXPECT_EQ(reduced.width(), 2);
  EXPECT_EQ(reduced.height(), 1);
  EXPECT_EQ(reduced(0, 0), (Bgr{2, 20, 1}));
  EXPECT_EQ(reduced(1, 0), (Bgr{}));
}

TEST(ReducedPicture, SilhouettesGoAndComeAsRuns) {
  Silhouette silhouette(6, 4);
  for (const int y : {0, 1}) silhouette.Set(2, y);
  for (const int x : {0, 1, 2, 3, 4, 5}) silhouette.Set(x, 3);
  std::vector<std::int32_t> runs;
  ReduceSilhouette(silhouette, 2, runs);
  EXPECT_THAT(runs, ElementsAre(1, 1, 1, 3));
  const Silhouette back = SilhouetteFromRuns(runs, 3, 2);
  EXPECT_FALSE(back.Test(0, 0));
  EXPECT_TRUE(back.Test(1, 0));
  EXPECT_TRUE(back.Test(0, 1) && back.Test(2, 1));
}

TEST(ReducedPicture, RunsBeyondThePictureAreLeftOut) {
  const Silhouette silhouette = SilhouetteFromRuns({1, 2'000'000'000, -4, 2'000'000'000}, 3, 2);
  EXPECT_FALSE(silhouette.Test(0, 0));
  EXPECT_TRUE(silhouette.Test(2, 1));
}

}  // namespace
}  // namespace mocap
