#include "core/objective/flesh_term.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/fitted_body.h"
#include "tests/support/slopes.h"

namespace mocap {
namespace {

constexpr CapsuleSet kEveryCapsule = ~CapsuleSet{0};

class FleshTermTest : public FittedBody {
 protected:
  /// The evidence, looked at through so many of its voxels.
  void SetFlesh(const Evidence& evidence) {
    ChooseContacts(evidence, 250, 0, contacts_);
    term_.SetEvidence(evidence, contacts_, 0);
  }
  double At(const PoseState& pose, CapsuleSet capsules = kEveryCapsule) const {
    PosedBody posed;
    posed.Set(body_, pose);
    return term_.At(posed, capsules);
  }

  std::vector<Contact> contacts_;
  FleshTerm term_;
};

TEST_F(FleshTermTest, DescendsWhatItCosts) {
  const Evidence evidence = studio_.Show(body_, Standing({}));
  SetFlesh(evidence);
  // The hand of a forearm that is turned aside is a decimetre from the hanging one.
  const PoseState pose = Standing({.arm_l = {.raise = -65}, .leg_r = {.hip = 25, .knee = 20}});
  const PoseStep gradient = GradientOf(body_, pose, [&](const PosedBody& posed, auto& sums) {
    term_.Linearize(posed, kEveryCapsule, sums);
  });
  ExpectOpposite(gradient, SlopeOf([&](const PoseState& at) { return At(at); }, pose), 1e-4);
}

TEST_F(FleshTermTest, CostsNothingWithinTheFleshAndMoreOutside) {
  const PoseState truth = Standing({});
  const Evidence evidence = studio_.Show(body_, truth);
  SetFlesh(evidence);
  EXPECT_NEAR(At(truth), 0, 1e-9);
  double last = 0;
  for (const double raise : {-60.0, -50.0, -30.0}) {
    const double nats = At(Standing({.arm_l = {.raise = raise}}));
    EXPECT_GT(nats, last) << raise;
    last = nats;
  }
}

TEST_F(FleshTermTest, OfSomeCapsulesIsAPartOfTheWhole) {
  const Evidence evidence = studio_.Show(body_, Standing({}));
  SetFlesh(evidence);
  const PoseState pose = Standing({.arm_l = kArmOut, .arm_r = kArmOut});
  constexpr CapsuleSet kSome = 0x55555555;
  EXPECT_GT(At(pose, kSome), 0);
  EXPECT_NEAR(At(pose, kSome) + At(pose, ~kSome), At(pose), 1e-9);
}

TEST_F(FleshTermTest, OfAHullWithHolesWeighsLess) {
  Evidence evidence = studio_.Show(body_, Standing({}));
  const PoseState arm_out = Standing({.arm_l = {.raise = 80}});
  SetFlesh(evidence);
  const double whole = At(arm_out), missing = evidence.MissingShare();
  ASSERT_GT(whole, 1);
  for (std::size_t i = 0; i < evidence.edges.size(); i += 2) evidence.edges[i].misses_hull = true;
  SetFlesh(evidence);
  EXPECT_NEAR(At(arm_out), whole * (1 - evidence.MissingShare()) / (1 - missing), 1e-6);
}

TEST_F(FleshTermTest, IsSilentWhereNoFleshWasSeen) {
  const Evidence nothing{};
  SetFlesh(nothing);
  EXPECT_FALSE(term_.WayToFlesh(Vector3::Zero()));
  EXPECT_EQ(At(Standing({})), 0);
}

}  // namespace
}  // namespace mocap
