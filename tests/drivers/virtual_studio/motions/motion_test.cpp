#include "drivers/virtual_studio/motions/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/people/person_mesh.h"
#include "drivers/virtual_studio/people/wheelchair.h"
#include "drivers/virtual_studio/room/room_plan.h"
#include "tests/support/joint_limits.h"

namespace mocap::simulation {
namespace {

class EveryMotion : public ::testing::TestWithParam<std::string_view> {
 protected:
  // Some people of all sizes, and poses over more than a round of every motion.
  template <typename Check>
  void ForPoses(Check check) {
    constexpr std::array<double, 3> kStatures_mm = {1100, 1750, 2000};
    for (std::size_t i = 0; i < kStatures_mm.size(); ++i) {
      const Anthropometry body = MakeAnthropometry(kStatures_mm[i], 11 + i);
      const auto motion = MakeMotion(GetParam(), body, 11 + i);
      for (double t = 0; t < 40; t += 0.037) check(body, motion->PoseAt(t), t);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Simulated, EveryMotion, ::testing::ValuesIn(kMotionNames),
                         [](const auto& motion) { return std::string(motion.param); });

TEST_P(EveryMotion, StaysWithinTheLimitsOfJoints) {
  ForPoses(
      [](const Anthropometry&, const BodyPose& pose, double t) { ExpectWithinLimits(pose, t); });
}

TEST_P(EveryMotion, StaysInTheRoom) {
  const bool leaves = GetParam() == "visit";
  const double low_x = leaves ? kDoorX_mm - kDoorJamb_mm - kCorridorDepth_mm : -2200;
  const double far_y = leaves ? kCorridorHalfLength_mm + kDoorY_mm : 2200;
  ForPoses([&](const Anthropometry& body, const BodyPose& pose, double t) {
    for (const Vector3& p_W : PointsOf(body, PlaceBones(body, pose))) {
      ASSERT_GT(p_W.x(), low_x) << t;
      ASSERT_LT(p_W.x(), 2200) << t;
      ASSERT_LT(std::abs(p_W.y()), far_y) << t;
      ASSERT_GT(p_W.z(), 0) << t;
      ASSERT_LT(p_W.z(), kRoomZ_mm) << t;
    }
  });
}

TEST_P(EveryMotion, KeepsBonesAsLongAsTheyAre) {
  ForPoses([](const Anthropometry& body, const BodyPose& pose, double t) {
    const TruePoints p = PointsOf(body, PlaceBones(body, pose));
    const auto length = [&p](TruthPoint a, TruthPoint b, int side) {
      return (p[static_cast<int>(a) + side] - p[static_cast<int>(b) + side]).norm();
    };
    for (const int side : {kLeft, kRight}) {
      ASSERT_NEAR(length(TruthPoint::kHipL, TruthPoint::kKneeL, side), body.thigh_mm, 1e-6) << t;
      ASSERT_NEAR(length(TruthPoint::kKneeL, TruthPoint::kAnkleL, side), body.shank_mm, 1e-6) << t;
      ASSERT_NEAR(length(TruthPoint::kShoulderL, TruthPoint::kElbowL, side), body.upper_arm_mm,
                  1e-6)
          << t;
      ASSERT_NEAR(length(TruthPoint::kElbowL, TruthPoint::kWristL, side), body.forearm_mm, 1e-6)
          << t;
      ASSERT_NEAR(length(TruthPoint::kWristL, TruthPoint::kFingertipsL, side), body.hand_mm, 1e-6)
          << t;
    }
    ASSERT_NEAR((p[static_cast<int>(TruthPoint::kHipL)] + p[static_cast<int>(TruthPoint::kHipR)] -
                 2 * p[static_cast<int>(TruthPoint::kPelvis)])
                    .norm(),
                0, 1e-6)
        << t;
  });
}

// 30 g is more than a runner's knee bears at contact; a jump in a path would be thousands.
TEST_P(EveryMotion, MovesWithoutJerks) {
  constexpr double kStep_s = 0.005, kMost_mm_s2 = 30 * 9810;
  const Anthropometry body = MakeAnthropometry(1750, 4);
  const auto motion = MakeMotion(GetParam(), body, 4);
  TruePoints before = PointsOf(body, PlaceBones(body, motion->PoseAt(0)));
  TruePoints now = PointsOf(body, PlaceBones(body, motion->PoseAt(kStep_s)));
  for (int i = 2; i < 6000; ++i) {
    const TruePoints after = PointsOf(body, PlaceBones(body, motion->PoseAt(i * kStep_s)));
    for (int k = 0; k < kTruthPointCount; ++k)
      ASSERT_LT((after[k] - 2 * now[k] + before[k]).norm() / (kStep_s * kStep_s), kMost_mm_s2)
          << kTruthPointNames[k] << " at " << i * kStep_s << " s";
    before = now;
    now = after;
  }
}

TEST_P(EveryMotion, PutsTheSolesOnTheFloor) {
  const Anthropometry body = MakeAnthropometry(1750, 6);
  const auto motion = MakeMotion(GetParam(), body, 6);
  Outfit outfit = MakeOutfit(6, {});
  outfit.costume = PlainCostume(GetParam());  // In a wheelchair, the wheels are on the floor.
  const PersonMesh mesh = BuildPersonMesh(body, outfit, 6);
  std::vector<Eigen::Vector3f> p_W, n_W;
  double lowest = 1e9;
  for (double t = 0; t < 10; t += 0.03) {
    SkinMesh(mesh, PlaceBones(body, motion->PoseAt(t)), p_W, n_W);
    double sole = 1e9;
    for (const Eigen::Vector3f& p : p_W) sole = std::min<double>(sole, p.z());
    ASSERT_GT(sole, -5) << t;
    lowest = std::min(lowest, sole);
    const bool flies = GetParam() == "run" || GetParam() == "jump" || GetParam() == "step";
    if (!flies) {
      ASSERT_LT(sole, 5) << t;
    }
  }
  EXPECT_LT(lowest, 2);
}

TEST_P(EveryMotion, DependsOnTheSeedAlone) {
  const Anthropometry body = MakeAnthropometry(1750, 6);
  const auto pelvis = [&](std::uint64_t seed) -> Vector3 {
    return MakeMotion(GetParam(), body, seed)->PoseAt(7.3).p_WPelvis;
  };
  EXPECT_EQ(pelvis(6), pelvis(6));
  EXPECT_NE(pelvis(6), pelvis(7));
}

TEST(Wheelchair, FitsSmallAndTallPeople) {
  for (const double stature_mm : {1100.0, 1750.0, 2000.0}) {
    const Anthropometry body = MakeAnthropometry(stature_mm, 3);
    const BonePoses bones = PlaceBones(body, MakeMotion("roll", body, 3)->PoseAt(0.4));
    const Wheelchair chair = FitWheelchair(body);
    for (const int side : {kLeft, kRight}) {
      // The soles are on the footrest, the thighs level, the hands near the tyres' tops.
      EXPECT_NEAR(bones[kFootL + side].p.z(), chair.footrest_mm + body.ankle_to_sole_mm, 2);
      EXPECT_NEAR(bones[kShankL + side].p.z(), chair.hips_mm, 0.06 * stature_mm);
      EXPECT_NEAR(bones[kHandL + side].p.z(), 2 * chair.wheel_radius_mm, 0.09 * stature_mm);
    }
  }
}

TEST(Gait, AFlatFootDoesNotSlide) {
  const Anthropometry body = MakeAnthropometry(1750, 6);
  const GaitStyle style = WalkingStyle(body);
  const Gait gait(body, style, [](double t_s) {
    return Track{Vector2(1100 * t_s, 80 * t_s), 0.07};
  });
  int flat_frames = 0;
  for (double t = 0; t < 5; t += 0.01)
    for (const int side : {kLeft, kRight}) {
      const double phase = gait.PhaseOf(side, t);
      if (phase < 0.12 || phase > 0.28) continue;
      const auto ankle = [&](double at) {
        return PlaceBones(body, gait.PoseAt(at))[kFootL + side].p;
      };
      EXPECT_LT((ankle(t + 0.01) - ankle(t)).norm(), 0.2);
      ++flat_frames;
    }
  EXPECT_GT(flat_frames, 100);
}

TEST(Gait, AWalkersKneesBendAsInTextbooks) {
  const Anthropometry body = MakeAnthropometry(1750, 6);
  const Gait gait(body, WalkingStyle(body), [](double t_s) {
    return Track{Vector2(1080 * t_s, 0), 0};
  });
  // Perry and Burnfield: about 60 degrees in the swing, nearly straight at contact.
  double most = 0, least = 4;
  for (double t = 0; t < 4; t += 0.01) {
    most = std::max(most, gait.PoseAt(t).legs[kLeft].knee);
    least = std::min(least, gait.PoseAt(t).legs[kLeft].knee);
  }
  EXPECT_NEAR(most / kDegree, 62, 10);
  EXPECT_LT(least / kDegree, 15);
}

TEST(Motion, AnUnknownNameIsRefusedWithTheKnownOnes) {
  const Anthropometry body = MakeAnthropometry(1750, 1);
  try {
    MakeMotion("fly", body, 1);
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_NE(std::string(error.what()).find("\"fly\""), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("walk"), std::string::npos);
  }
}

}  // namespace
}  // namespace mocap::simulation
