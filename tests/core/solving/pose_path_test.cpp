#include "core/solving/pose_path.h"

#include <gtest/gtest.h>

#include <vector>

#include "config/load_config.h"

namespace mocap {
namespace {

class Path : public ::testing::Test {
 protected:
  Candidate At(double x_mm, double nats) const {
    Candidate candidate;
    candidate.pose.X_WT.p = Vector3(x_mm, 0, 1000);
    candidate.pose.theta = JointAngles::Zero(body_.joint_count());
    candidate.nats = nats;
    return candidate;
  }
  std::vector<PathStep> Through(const std::vector<Candidates>& sets,
                                const std::optional<PoseState>& before = {}) const {
    return LikeliestPath(sets, std::vector<double>(sets.size(), 0.1), body_, before);
  }
  static std::vector<double> PlacesOf(const std::vector<PathStep>& path) {
    std::vector<double> x_mm;
    for (const PathStep& step : path) x_mm.push_back(step.pose ? step.pose->X_WT.p.x() : -1);
    return x_mm;
  }

  const BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
};

TEST_F(Path, LaterSetsDecideAboutEarlierOnes) {
  // The wrong pose explains the first set a little better, and all others much worse.
  std::vector<Candidates> sets = {{At(0, 10), At(2000, 0)}};
  for (int i = 0; i < 9; ++i) sets.push_back({At(0, 0), At(2000, 60)});
  const std::vector<PathStep> path = Through(sets);
  EXPECT_EQ(PlacesOf(path), std::vector<double>(10, 0.0));
  EXPECT_GT(path.front().probability, 0.95);
}

TEST_F(Path, DoesNotJumpForASetThatErrs) {
  std::vector<Candidates> sets(9, {At(0, 0), At(2000, 60)});
  sets[4] = {At(0, 20), At(2000, 0)};
  EXPECT_EQ(PlacesOf(Through(sets)), std::vector<double>(9, 0.0));
}

TEST_F(Path, JumpsWhereTheEvidenceIsStrongAndSaysSo) {
  std::vector<Candidates> sets(5, {At(0, 0), At(2000, 500)});
  sets.resize(10, {At(0, 500), At(2000, 0)});
  const std::vector<PathStep> path = Through(sets);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(path[i].pose->X_WT.p.x(), i < 5 ? 0 : 2000);
    EXPECT_EQ(path[i].jumps, i == 5);
  }
}

TEST_F(Path, HasNoPoseWhereNobodyWasFound) {
  const std::vector<PathStep> path = Through({{}, {At(0, 0)}, {}, {At(30, 0)}, {}});
  EXPECT_EQ(PlacesOf(path), (std::vector<double>{-1, 0, -1, 30, -1}));
  EXPECT_FALSE(path[3].jumps);
}

TEST_F(Path, GoesOnFromAPoseThatIsDecided) {
  const std::vector<Candidates> sets = {{At(0, 5), At(2000, 0)}, {At(0, 0), At(2000, 0)}};
  EXPECT_EQ(PlacesOf(Through(sets)), (std::vector<double>{2000, 2000}));
  EXPECT_EQ(PlacesOf(Through(sets, At(0, 0).pose)), (std::vector<double>{0, 0}));
}

TEST_F(Path, IsInDoubtBetweenPosesThatExplainEquallyMuch) {
  const std::vector<PathStep> path = Through({{At(0, 0), At(2000, 0)}, {At(0, 0), At(2000, 0)}});
  EXPECT_NEAR(path.front().probability, 0.5, 1e-9);
  // The same pose of two runs is no rival of itself.
  EXPECT_NEAR(Through({{At(0, 0), At(5, 0)}}).front().probability, 1, 1e-9);
}

}  // namespace
}  // namespace mocap
