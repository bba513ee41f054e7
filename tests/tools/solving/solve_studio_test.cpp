#include "tools/solving/solve_studio.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "config/load_config.h"
#include "drivers/simulation/simulated_studio.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

class CountingSink : public PoseSink {
 public:
  void OnSet(const TrackedSet&) override { ++sets; }
  int sets = 0;
};

class SolveStudioTest : public ::testing::Test {
 protected:
  static Studio Walk() {
    SimulatedStudioOptions options = RecordedSimulation();
    options.motion = "walk";
    options.seconds = 1;
    options.fps = 15;
    options.width_px = 320;
    options.height_px = 240;
    return OpenSimulatedStudio(options);
  }
  Solved Solve(const std::string& work, CountingSink& live, TellProgress tell) const {
    return SolveStudio(
        Walk(), LoadBodyTable("full"),
        {.work = folder_.path() / work, .mark = "walk", .live = &live, .tell = std::move(tell)});
  }

  const testing::TemporaryFolder folder_;
};

TEST_F(SolveStudioTest, GoesOnWhereItWasCutOff) {
  CountingSink whole, cut_off, goes_on;
  const Solved expected = Solve("whole", whole, [](const std::string&) {});
  const auto stop_before_sizes = [](const std::string& step) {
    if (step == "sizes") throw std::runtime_error("stopped");
  };
  EXPECT_THROW(Solve("cut off", cut_off, stop_before_sizes), std::runtime_error);
  std::vector<std::string> steps;
  const Solved solved =
      Solve("cut off", goes_on, [&](const std::string& step) { steps.push_back(step); });
  EXPECT_EQ(cut_off.sets, 15);
  EXPECT_EQ(goes_on.sets, 0);
  EXPECT_EQ(steps, (std::vector<std::string>{"sizes", "person 1: smoothing"}));
  ASSERT_EQ(solved.people.size(), 1U);
  const std::vector<PoseRow>&poses = solved.people.at(1).poses,
        &expected_poses = expected.people.at(1).poses;
  ASSERT_EQ(poses.size(), expected_poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_EQ(poses[i].points_W, expected_poses[i].points_W) << i;
}

TEST_F(SolveStudioTest, TellsProbabilityAndContacts) {
  CountingSink live;
  const Solved solved = Solve("work", live, [](const std::string&) {});
  for (const PoseRow& row : solved.people.at(1).poses) {
    EXPECT_GT(row.probability, 0.5);
    EXPECT_TRUE(row.contacts.allFinite());
    EXPECT_GT(row.point_std_mm.minCoeff(), 10);
  }
}

}  // namespace
}  // namespace mocap
