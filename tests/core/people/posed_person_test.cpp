#include "core/people/posed_person.h"

#include <gtest/gtest.h>

#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"

namespace mocap {
namespace {

constexpr double kVoxel_mm = 50;

PosedPerson StandingBeliever(bool is_lost) {
  const BodyModel body(LoadBodyTable("full"), AverageSizes(1750));
  PoseState pose;
  pose.X_WT.p = Vector3(0, 0, 1200);
  pose.theta.setZero(body.joint_count());
  PosedPerson person;
  PosePerson(body, pose, 250, person);
  person.is_lost = is_lost;
  return person;
}

TEST(BelievedFlesh, IsWhatCamerasCannotTellWithinABodyAndNothingElse) {
  VoxelGrid flesh;
  flesh.Reset({-10, -10, 0}, {20, 20, 40}, kVoxel_mm);
  const Eigen::Vector3i trunk(10, 10, 24), beside(1, 1, 24), empty(10, 10, 25);
  const std::vector<Eigen::Vector3i> doubtful = {trunk, beside};
  Observation room(flesh, {});
  room.doubtful = doubtful;
  VoxelGrid memory;
  const std::vector<PosedPerson> known = {StandingBeliever(false)}, lost = {StandingBeliever(true)};
  const VoxelGrid& grid = BelieveWithin(known, room, memory);
  EXPECT_TRUE(grid.Test(trunk.x(), trunk.y(), trunk.z()));
  EXPECT_FALSE(grid.Test(beside.x(), beside.y(), beside.z()));
  EXPECT_FALSE(grid.Test(empty.x(), empty.y(), empty.z())) << "a camera calls it empty";
  EXPECT_FALSE(BelieveWithin(lost, room, memory).Test(trunk.x(), trunk.y(), trunk.z()));
  EXPECT_EQ(&BelieveWithin({}, room, memory), &flesh);
}

}  // namespace
}  // namespace mocap
