#include "core/objective/overlap_term.h"

#include <gtest/gtest.h>

#include "tests/support/fitted_body.h"
#include "tests/support/slopes.h"

namespace mocap {
namespace {

constexpr CapsuleSet kWholeBody = ~CapsuleSet{0};

class OverlapTermTest : public FittedBody {
 protected:
  double At(const PoseState& pose, CapsuleSet limbs = kWholeBody,
            CapsuleSet present = kWholeBody) const {
    PosedBody posed;
    posed.Set(body_, pose);
    return OverlapTerm{}.At(posed, limbs, present);
  }
  template <typename Choose>
  CapsuleSet CapsulesThat(const Choose& choose) const {
    CapsuleSet capsules = 0;
    for (int i = 0; i < std::ssize(body_.shape()); ++i)
      if (choose(body_.shape()[i])) capsules |= CapsuleSet{1} << i;
    return capsules;
  }
  CapsuleSet CapsulesOf(BodyPart part) const {
    return CapsulesThat([part](const Capsule& capsule) { return capsule.part == part; });
  }
  void ExpectLinearised(const PoseState& pose, double share) {
    const PoseStep gradient = GradientOf(body_, pose, [&](const PosedBody& posed, auto& sums) {
      OverlapTerm{}.Linearize(posed, kWholeBody, kWholeBody, sums);
    });
    ExpectOpposite(gradient, SlopeOf([&](const PoseState& at) { return At(at); }, pose), share);
  }

  static constexpr ArmStance kInTheTrunk{.raise = -75, .twist = 90, .elbow = 60};
  static constexpr LegStance kAcross{.hip = 5, .spread = -12, .knee = 10};
};

TEST_F(OverlapTermTest, OfAnArmInTheTrunkDescendsWhatItCosts) {
  ExpectLinearised(Standing({.arm_l = kInTheTrunk}), 1e-4);
}

TEST_F(OverlapTermTest, OfLegsInEachOtherDescendsWhatItCosts) {
  ExpectLinearised(Standing({.leg_l = kAcross, .leg_r = kAcross}), 1e-4);
}

TEST_F(OverlapTermTest, CostsNothingWhereLimbsAreApart) {
  EXPECT_EQ(At(Standing({.arm_l = kArmOut, .arm_r = kArmOut})), 0);
}

TEST_F(OverlapTermTest, CostsMoreTheDeeperALegIsInTheOther) {
  // Feet are thin: they soon come out on the other side.
  const CapsuleSet without_feet = CapsulesThat([this](const Capsule& capsule) {
    if (capsule.carrier < 0) return true;
    const std::string& joint = body_.table().joints[capsule.carrier].name;
    return !joint.starts_with("subtalar") && !joint.starts_with("toes");
  });
  double last = 0;
  for (const double spread : {-5.0, -6.0, -8.0, -10.0}) {
    const double nats = At(Standing({.leg_l = {.spread = spread}, .leg_r = {.spread = spread}}),
                           without_feet, without_feet);
    EXPECT_GT(nats, last) << spread;
    last = nats;
  }
}

TEST_F(OverlapTermTest, OfALimbWithoutTheOtherPartIsNothing) {
  const PoseState pose = Standing({.arm_l = kInTheTrunk});
  const CapsuleSet arm = CapsulesOf(BodyPart::kLowerArmL);
  EXPECT_GT(At(pose, arm), 0);
  EXPECT_EQ(At(pose, ~arm), 0) << "no other limb is in anything";
  EXPECT_EQ(At(pose, arm, arm), 0);
}

TEST_F(OverlapTermTest, PartsThatAreJoinedDoNotOverlap) {
  EXPECT_FALSE(MayOverlap(BodyPart::kCalfL, BodyPart::kThighL));
  EXPECT_TRUE(MayOverlap(BodyPart::kCalfL, BodyPart::kThighR));
  EXPECT_FALSE(MayOverlap(BodyPart::kLowerArmL, BodyPart::kLowerArmL));
  EXPECT_FALSE(MayOverlap(BodyPart::kLowerArmL, BodyPart::kUpperArmL));
  EXPECT_TRUE(MayOverlap(BodyPart::kLowerArmL, BodyPart::kLowerArmR));
  EXPECT_TRUE(MayOverlap(BodyPart::kLowerArmR, BodyPart::kTorso));
  EXPECT_FALSE(MayOverlap(BodyPart::kTorso, BodyPart::kLowerArmR)) << "the arm is the limb";
}

TEST(Overlap, IsOfFleshAndNotOfCloth) {
  const Capsule leg{
      .a_T = Vector3(0, 0, 400), .b_T = Vector3(0, 0, 0), .radius_a_mm = 60, .radius_b_mm = 40};
  Capsule draped = leg;
  draped.cloth_a_mm = 80, draped.cloth_b_mm = 120;
  const RigidTransform beside{Matrix3::Identity(), Vector3(45, 0, 0)};
  const PosedCapsule bare(leg, {}), other(leg, beside);
  const PosedCapsule in_skirt(draped, {}), other_in_skirt(draped, beside);
  for (const double share : kCoreShares) {
    const Vector3 p_W = CorePlace(bare, share);
    EXPECT_DOUBLE_EQ(RadiusAt(in_skirt, share), RadiusAt(bare, share));
    EXPECT_NEAR(in_skirt.DistanceTo(p_W).outside_mm,
                bare.DistanceTo(p_W).outside_mm - draped.cloth_a_mm -
                    share * (draped.cloth_b_mm - draped.cloth_a_mm),
                1e-9);
    EXPECT_NEAR(OverlapDepth(in_skirt, other_in_skirt, other_in_skirt.DistanceTo(p_W)),
                OverlapDepth(bare, other, other.DistanceTo(p_W)), 1e-9);
  }
}

}  // namespace
}  // namespace mocap
