#include "drivers/virtual_studio/people/anthropometry.h"

#include <gtest/gtest.h>

#include "drivers/virtual_studio/people/skeleton.h"

namespace mocap::simulation {
namespace {

TEST(Anthropometry, SegmentsAddUpToTheStature) {
  for (const double stature_mm : {1100.0, 1450.0, 1750.0, 2000.0}) {
    const Anthropometry body = MakeAnthropometry(stature_mm, 3);
    BodyPose upright;
    upright.p_WPelvis.z() = body.hip_height_mm();
    const BonePoses bones = PlaceBones(body, upright);
    const double vertex_mm = (bones[kHead] * HeadCenterInHead(body)).z() + body.head_mm / 2;
    EXPECT_NEAR(vertex_mm, stature_mm, 1e-9);
    EXPECT_NEAR(bones[kFootL].p.z(), body.ankle_to_sole_mm, 1e-9);
  }
}

TEST(Anthropometry, AnAverageAdultHasWintersProportions) {
  double hip = 0, elbow = 0, knee = 0;
  constexpr int kPeople = 50;
  for (int seed = 0; seed < kPeople; ++seed) {
    const Anthropometry body = MakeAnthropometry(1755, static_cast<std::uint64_t>(seed));
    hip += body.hip_height_mm() / 1755 / kPeople;
    knee += body.calf_mm() / 1755 / kPeople;
    elbow += (body.hip_height_mm() + body.shoulder_mm - body.upper_arm_mm) / 1755 / kPeople;
  }
  EXPECT_NEAR(hip, 0.530, 0.008);
  EXPECT_NEAR(knee, 0.285, 0.006);
  EXPECT_NEAR(elbow, 0.630, 0.008);
}

TEST(Anthropometry, AChildHasALargerHeadAndShorterLegsForItsStature) {
  const Anthropometry child = MakeAnthropometry(1150, 5), adult = MakeAnthropometry(1755, 5);
  EXPECT_GT(child.head_mm / 1150, 1.25 * adult.head_mm / 1755);
  EXPECT_LT(child.head_mm, adult.head_mm);
  EXPECT_LT(child.leg_mm() / 1150, 0.96 * adult.leg_mm() / 1755);
}

TEST(Anthropometry, TheSeedAloneMakesThePerson) {
  const Anthropometry a = MakeAnthropometry(1700, 8), b = MakeAnthropometry(1700, 8);
  const Anthropometry other = MakeAnthropometry(1700, 9);
  EXPECT_EQ(a.girth, b.girth);
  EXPECT_EQ(a.thigh_mm, b.thigh_mm);
  EXPECT_NE(a.girth, other.girth);
  EXPECT_NE(a.thigh_mm, other.thigh_mm);
}

}  // namespace
}  // namespace mocap::simulation
