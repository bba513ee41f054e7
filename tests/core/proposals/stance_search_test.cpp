#include "core/proposals/stance_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/fitted_body.h"

namespace mocap {
namespace {

class Search : public FittedBody {
 protected:
  const std::vector<StanceCandidate>& Find(const SearchScope& scope = {}) {
    return search_.Find(objective_, scope);
  }

  /// Somebody in a hat with a broad brim.
  Evidence WithHat(double x_mm = 50) const {
    PoseState pose = Standing({});
    pose.X_WT.p.x() = x_mm;
    const Posture posture = body_.PostureAt(pose);
    std::vector<PosedCapsule> flesh;
    body_.PoseShape(posture, flesh);
    const Vector3 brim_W =
        body_.PointsAt(posture).col(static_cast<int>(Point::kHead)) + Vector3(0, 0, 80);
    flesh.push_back({brim_W - Vector3(150, 0, 0), brim_W + Vector3(150, 0, 0), 80, 80});
    const RoundStudio::CarvedBody carved = studio_.Carve(flesh, 100);
    Evidence evidence;
    evidence.Gather({carved.hull, carved.outlines});
    return evidence;
  }

  StanceSearch search_{body_};
};

TEST_F(Search, FindsAPersonOfKnownSizesTheBestFirst) {
  std::size_t most = 0;
  for (const ArmStance& arm : {ArmStance{.raise = 0}, kArmOut}) {
    const PoseState truth = Standing({.arm_l = arm});
    See(truth);
    search_.StartOver();
    const std::vector<StanceCandidate>& found = Find();
    ASSERT_FALSE(found.empty());
    EXPECT_LT(Error(found.front().pose, truth), 30);
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i - 1].nats, found[i].nats);
    most = std::max(most, found.size());
  }
  // An arm straight out leaves no doubt: a single pose is found.
  EXPECT_GT(most, 1u);
}

TEST_F(Search, FindsPosesThatDiffer) {
  See(Standing({}));
  const std::vector<StanceCandidate>& found = Find();
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(Error(found[i].pose, found[j].pose), 30);
}

TEST_F(Search, WithLessEffortCostsLess) {
  See(Standing({}));
  const double before = objective_.evaluations();
  Find({0.1});
  const double small = objective_.evaluations() - before;
  EXPECT_GT(small, 0);
  search_.StartOver();
  Find({1});
  EXPECT_GT(objective_.evaluations() - before - small, 2 * small);
}

TEST_F(Search, KeepsTheBestOfTheFrameBeforeWhereThereIsLittleTime) {
  const PoseState truth = Standing({.arm_l = {.raise = 10, .forward = 50, .elbow = 100}});
  See(truth);
  search_.Remember(body_.sizes(), truth);
  EXPECT_LT(Error(Find({0.02}).front().pose, truth), 15);
}

// At 50 mm, and a few millimetres around it, the voxels of head and brim fit a bare head as well.
TEST_F(Search, FindsWhatSomebodyWearsIfThatMayBe) {
  int hats = 0;
  for (const double x_mm : {-100, -75, -50, -25, 0, 25, 50, 75, 100}) {
    See(WithHat(x_mm));
    search_.StartOver();
    hats += Find().front().things.test(static_cast<int>(Thing::kHat));
    EXPECT_TRUE(Find({1, Things{}}).front().things.none());
  }
  EXPECT_GE(hats, 8);
}

// What no part explains may be a stray blob of a silhouette.
TEST_F(Search, TakesNothingForAThingWhereFleshIsTorn) {
  Evidence torn = WithHat();
  for (std::size_t i = 0; i < torn.edges.size(); i += 4) torn.edges[i].misses_hull = true;
  See(std::move(torn));
  EXPECT_TRUE(Find().front().things.none());
}

TEST_F(Search, GivesTheSameBitsForTheSameEvidence) {
  See(Standing({}));
  const std::vector<StanceCandidate> first = Find();
  search_.StartOver();
  const std::vector<StanceCandidate>& second = Find();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].nats, second[i].nats);
    EXPECT_EQ(first[i].pose.theta, second[i].pose.theta);
  }
}

}  // namespace
}  // namespace mocap
