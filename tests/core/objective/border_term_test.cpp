#include "core/objective/border_term.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "tests/support/fitted_body.h"
#include "tests/support/slopes.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;

constexpr CapsuleSet kAllCapsules = ~CapsuleSet{0};

class BorderTermTest : public FittedBody {
 protected:
  double At(const BodyModel& body, const PoseState& pose,
            CapsuleSet capsules = kAllCapsules) const {
    PosedBody posed;
    posed.Set(body, pose);
    return term_.At(posed, capsules);
  }
  void SeeBorders(const PoseState& truth) {
    evidence_ = studio_.Show(body_, truth);
    term_.SetEvidence(evidence_, 0);
  }

  BorderTerm term_;
};

TEST_F(BorderTermTest, DescendsWhatItCosts) {
  const PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
  SeeBorders(truth);
  const PoseState pose = Off(truth);
  const PoseStep gradient = GradientOf(body_, pose, [&](const PosedBody& posed, auto& sums) {
    term_.Linearize(posed, kAllCapsules, sums);
  });
  ExpectOpposite(gradient, SlopeOf([&](const PoseState& at) { return At(body_, at); }, pose), 1e-4);
}

TEST_F(BorderTermTest, CostsMoreTheFartherFleshIsBeyondTheBorder) {
  const PoseState truth = Standing({.arm_l = kArmOut});
  SeeBorders(truth);
  double last = At(body_, truth);
  for (const double more_mm : {20.0, 40.0, 70.0}) {
    BodySizes sizes = body_.sizes();
    sizes.lower_arm += more_mm;
    const double nats = At(BodyModel(body_.table(), sizes), truth);
    EXPECT_GT(nats, last) << more_mm;
    last = nats;
  }
}

TEST_F(BorderTermTest, CamerasThatShowTheSameSayNoMoreThanOneOfThem) {
  const PoseState truth = Standing({.arm_l = kArmOut});
  SeeBorders(truth);
  const PoseState pose = Off(truth);
  const double once = At(body_, pose);
  ASSERT_GT(once, 0);
  const std::vector<Outline> borders = evidence_.borders;
  evidence_.borders.insert(evidence_.borders.end(), borders.begin(), borders.end());
  term_.SetEvidence(evidence_, 0);
  EXPECT_NEAR(At(body_, pose), once, 1e-9);
}

TEST_F(BorderTermTest, OfSomeCapsulesIsAPartOfTheWhole) {
  const PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
  SeeBorders(truth);
  const PoseState pose = Off(truth);
  constexpr CapsuleSet kSome = 0x55555555;
  EXPECT_GT(At(body_, pose, kSome), 0);
  EXPECT_NEAR(At(body_, pose, kSome) + At(body_, pose, ~kSome), At(body_, pose), 1e-9);
}

TEST_F(BorderTermTest, HeelsAndElbowsAreNotHeldTwice) {
  const auto held = [this](std::string_view joint) {
    const auto capsule = std::ranges::find_if(body_.shape(), [&](const Capsule& one) {
      return one.carrier >= 0 && body_.table().joints[one.carrier].name == joint;
    });
    return capsule->held;
  };
  EXPECT_THAT(held("elbow_r_z"), ElementsAre(false, true, true));
  EXPECT_THAT(held("subtalar_l_x"), ElementsAre(false, false, false));
  EXPECT_THAT(held("toes_l_y"), ElementsAre(true, false, true));
  EXPECT_THAT(held("knee_l_y"), ElementsAre(true, true, true));
  EXPECT_TRUE(body_.shape().front().held[0]) << "the torso";
}

}  // namespace
}  // namespace mocap
