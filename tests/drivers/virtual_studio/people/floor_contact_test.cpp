#include "drivers/virtual_studio/people/floor_contact.h"

#include <gtest/gtest.h>

#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/motions/motion.h"

namespace mocap::simulation {
namespace {

constexpr double kApart_s = 0.001;

FloorContacts AtRest(const Anthropometry& body, const BodyPose& pose) {
  const BonePoses bones = PlaceBones(body, pose);
  return ContactsOf(body, bones, bones, kApart_s);
}

TEST(FloorContact, FlatFeetStandOnHeelsAndForefeet) {
  const Anthropometry body = MakeAnthropometry(1750, 1);
  BodyPose pose;
  pose.p_WPelvis.z() = body.hip_height_mm();
  EXPECT_EQ(AtRest(body, pose), (FloorContacts{true, true, true, true}));
  pose.p_WPelvis.z() += 2 * kContactHeight_mm;
  EXPECT_EQ(AtRest(body, pose), (FloorContacts{false, false, false, false}));
}

TEST(FloorContact, ARaisedHeelLeavesTheForefootAndRaisedToesTheHeel) {
  const Anthropometry body = MakeAnthropometry(1750, 1);
  BodyPose pose;
  pose.p_WPelvis.z() = 0.98 * body.hip_height_mm();
  const auto roll = [&](double pitch) { return RollFoot(body, {0, 90, 0}, 0, pitch); };
  PlaceLeg(body, kLeft, roll(0.3), pose);
  PlaceLeg(body, kRight, roll(-0.3), pose);
  EXPECT_EQ(AtRest(body, pose), (FloorContacts{false, true, true, false}));
}

TEST(FloorContact, AFootThatSlidesDoesNotStand) {
  const Anthropometry body = MakeAnthropometry(1750, 1);
  BodyPose pose;
  pose.p_WPelvis.z() = body.hip_height_mm();
  const BonePoses bones = PlaceBones(body, pose);
  pose.p_WPelvis.x() += 2 * kContactSpeed_mm_s * kApart_s;
  EXPECT_EQ(ContactsOf(body, bones, PlaceBones(body, pose), kApart_s), FloorContacts{});
}

TEST(FloorContact, AWalkersFootStandsForThreeFifthsOfItsCycle) {
  const Anthropometry body = MakeAnthropometry(1750, 1);
  const std::unique_ptr<const Motion> walk = MakeMotion("walk", body, 1);
  const double cycle_s = 2 * WalkingStyle(body).step_s;
  std::array<int, kContactCount> standing{};
  int on_floor = 0;
  constexpr int kMoments = 2000;
  for (int i = 0; i < kMoments; ++i) {
    const double t_s = 2 * cycle_s * i / kMoments;
    const FloorContacts contacts =
        ContactsOf(body, PlaceBones(body, walk->PoseAt(t_s)),
                   PlaceBones(body, walk->PoseAt(t_s + kApart_s)), kApart_s);
    for (int k = 0; k < kContactCount; ++k) standing[k] += contacts[k];
    on_floor += contacts[0] || contacts[2];
  }
  EXPECT_NEAR(on_floor, WalkingStyle(body).duty * kMoments, 0.01 * kMoments);
  // Flat from a tenth to a third of the cycle, as in WalkingStyle.
  EXPECT_NEAR(standing[0], 0.35 * kMoments, 0.04 * kMoments);
  EXPECT_NEAR(standing[2], 0.54 * kMoments, 0.04 * kMoments);
}

}  // namespace
}  // namespace mocap::simulation
