#include "core/mikic2003/size_network.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocap::mikic2003 {
namespace {

// Of somebody of the paper's proportions, 2.9 torsos high without the head.
BodySizes Proportioned(double torso_mm) {
  BodySizes sizes;
  sizes.torso = torso_mm;
  sizes.thigh = kThighPerTorso * torso_mm;
  sizes.calf = kCalfPerTorso * torso_mm;
  sizes.upper_arm = kUpperArmPerTorso * torso_mm;
  sizes.lower_arm = kLowerArmPerTorso * torso_mm;
  return sizes;
}

LengthMeasurements LengthsOf(const BodySizes& sizes) {
  return {.thigh = sizes.thigh,
          .calf = sizes.calf,
          .upper_arm = sizes.upper_arm,
          .lower_arm = sizes.lower_arm,
          .height = sizes.torso + sizes.thigh + sizes.calf};
}

TEST(Figure13, LengthsThatFitProportionsStayAsTheyAre) {
  BodySizes sizes = Proportioned(500);
  EXPECT_LT(SizeNetwork().Update(LengthsOf(Proportioned(500)), sizes), 1e-6);
}

// Fig. 16: the first frame has a long torso and short legs.
TEST(Figure13, ALongTorsoAndShortLegsComeToTheirProportionsInAFewFrames) {
  const BodySizes truth = Proportioned(520);
  BodySizes sizes = truth;
  sizes.torso = 800, sizes.thigh = 250, sizes.calf = 400;
  SizeNetwork network;
  int frames = 0;
  while (network.Update(LengthsOf(truth), sizes) >= 3 && frames < 20) ++frames;
  EXPECT_LE(frames, 6);
  EXPECT_NEAR(sizes.torso, truth.torso, 40);
  EXPECT_NEAR(sizes.thigh, truth.thigh, 40);
  EXPECT_NEAR(sizes.calf, truth.calf, 40);
}

// §8.1: the iterations end when "the sum of body part length changes" is small. A thigh that grows
// as much as the calf shrinks does not count.
TEST(Figure13, TheSumOfChangesIsThatOfTheWholeBody) {
  const BodySizes before = Proportioned(500);
  BodySizes sizes = before;
  LengthMeasurements lengths = LengthsOf(before);
  *lengths.thigh += 30, *lengths.calf -= 30;
  const double change_mm = SizeNetwork().Update(lengths, sizes);
  EXPECT_GT(sizes.thigh - before.thigh, 3);
  EXPECT_LT(change_mm, 1);
  const auto sum = [](const BodySizes& of) {
    return of.torso + of.thigh + of.calf + of.upper_arm + of.lower_arm;
  };
  EXPECT_NEAR(change_mm, std::abs(sum(sizes) - sum(before)), 1e-9);
}

// With the leaf of height alone the posterior has a closed form: height = 2.9 torso + noise of
// variance 100² (thigh) + 100² (calf) + 100² (height).
TEST(Table3, WeighsHeightAgainstThePriorOfTheTorso) {
  BodySizes sizes = Proportioned(500);
  LengthMeasurements height_alone;
  height_alone.height = 1700;
  SizeNetwork().Update(height_alone, sizes);
  const double prior = 300.0 * 300, noise = 3 * 100.0 * 100;
  const double gain = 2.9 * prior / (2.9 * 2.9 * prior + noise);
  EXPECT_NEAR(sizes.torso, 500 + gain * (1700 - 2.9 * 500), 1e-6);
  EXPECT_NEAR(sizes.upper_arm, 0.55 * sizes.torso, 1e-6);
}

TEST(Figure13, WhoDoesNotStandUprightIsAsHighAsTheSumOfTheParts) {
  BodySizes upright = Proportioned(500), seated = Proportioned(500);
  LengthMeasurements lengths = LengthsOf(upright);
  SizeNetwork().Update(lengths, upright);
  lengths.height = 900;
  SizeNetwork().Update(lengths, seated);
  EXPECT_NEAR(seated.thigh, upright.thigh, 1e-6);
}

TEST(Figure13, LengthsOfLeftAndRightAreAveraged) {
  MeasuredPoints points;
  At(points, Point::kHipL) = Vector3(0, 0, 0);
  At(points, Point::kKneeL) = Vector3(0, 0, -400);
  At(points, Point::kHipR) = Vector3(0, 0, 0);
  At(points, Point::kKneeR) = Vector3(0, 0, -440);
  At(points, Point::kFootR) = Vector3(0, 0, -900);
  const LengthMeasurements lengths = MeasureLengths(points, 1500);
  EXPECT_EQ(lengths.thigh, 420);
  EXPECT_EQ(lengths.calf, 460);
  EXPECT_FALSE(lengths.upper_arm);
}

}  // namespace
}  // namespace mocap::mikic2003
