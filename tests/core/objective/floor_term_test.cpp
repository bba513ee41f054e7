#include "core/objective/floor_term.h"

#include <gtest/gtest.h>

#include "tests/support/fitted_body.h"
#include "tests/support/slopes.h"

namespace mocap {
namespace {

constexpr CapsuleSet kAllOfIt = ~CapsuleSet{0};

class FloorTermTest : public FittedBody {
 protected:
  double At(const PoseState& pose, CapsuleSet capsules = kAllOfIt) const {
    PosedBody posed;
    posed.Set(body_, pose);
    return FloorTerm{}.At(posed, capsules);
  }
  PoseState Sunk(double depth_mm) const {
    PoseState pose = Standing({});
    pose.X_WT.p.z() -= depth_mm;
    return pose;
  }
};

TEST_F(FloorTermTest, OfFeetInTheFloorDescendsWhatItCosts) {
  const PoseState pose = Sunk(15);
  const PoseStep gradient = GradientOf(body_, pose, [&](const PosedBody& posed, auto& sums) {
    FloorTerm{}.Linearize(posed, kAllOfIt, sums);
  });
  ExpectOpposite(gradient, SlopeOf([&](const PoseState& at) { return At(at); }, pose), 1e-4);
}

TEST_F(FloorTermTest, CostsMoreTheDeeperTheFeetAre) {
  double last = 0;
  for (const double depth_mm : {5.0, 10.0, 20.0, 60.0}) {
    const double nats = At(Sunk(depth_mm));
    EXPECT_GT(nats, last) << depth_mm;
    last = nats;
  }
}

TEST_F(FloorTermTest, CostsNothingAboveTheFloor) {
  EXPECT_EQ(At(Sunk(-30)), 0);
  EXPECT_EQ(At(Sunk(15), 0), 0) << "nothing is compared";
}

}  // namespace
}  // namespace mocap
