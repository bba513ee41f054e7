#include "core/surface_capture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/seen_body.h"
#include "tests/support/standing_height.h"
#include "tests/support/voxelized_body.h"

namespace mocap {
namespace {

constexpr std::int64_t kFrameNs = 33'333'333;

// A body that strolls along x with swinging arms and legs, on the floor.
PoseState Stroll(const BodyModel& body, int frame) {
  const double swing = std::sin(0.2 * frame);
  PoseState pose;
  pose.X_WT.R = ExpRotation(Vector3(0, 0, 0.3));
  pose.X_WT.p = Vector3(15.0 * frame, 5.0 * frame, StandingHeight(body.sizes()));
  Stance stance;
  stance.arm_l = {.raise = -70, .forward = 20 * swing, .elbow = 25};
  stance.arm_r = {.raise = -70, .forward = -20 * swing, .elbow = 25};
  stance.leg_l = {.hip = -20 * swing, .knee = 15 + 10 * swing};
  stance.leg_r = {.hip = 20 * swing, .knee = 15 - 10 * swing};
  pose.theta = AnglesOf(stance, body.table());
  PutOnFloor(body, pose);
  return pose;
}

bool IsLeg(BodyPart part) {
  return part == BodyPart::kThighL || part == BodyPart::kThighR || part == BodyPart::kCalfL ||
         part == BodyPart::kCalfR;
}

double MeanError(const BodyModel& truth, const PoseState& pose, const CaptureResult& result) {
  const BodyPoints expected = truth.PointsAt(truth.PostureAt(pose));
  return (result.points_W - expected).colwise().norm().mean();
}

class Capture : public ::testing::TestWithParam<std::string> {
 protected:
  const CaptureResult& See(const BodyModel& person, int frame) {
    return capture_.Update({Voxelize(person, Stroll(person, frame), 25), {}}, NextNs());
  }
  const CaptureResult& SeeNobody() {
    VoxelGrid empty;
    empty.Reset({0, 0, 0}, {0, 0, 0}, 25);
    return capture_.Update({empty, {}}, NextNs());
  }
  std::int64_t NextNs() { return now_ns_ += kFrameNs; }

  BodyTable table_ = LoadBodyTable(GetParam());
  const std::unique_ptr<MotionCapture> owned_ = MakeSurfaceCapture(table_);
  MotionCapture& capture_ = *owned_;
  std::int64_t now_ns_ = 1'000'000'000'000;
};

TEST_P(Capture, MeasuresAndFollowsAPersonFromTheFirstFrameOn) {
  const BodyModel person(table_, AverageSizes(1750));
  for (int frame = 0; frame < 10; ++frame) See(person, frame);
  EXPECT_LE(capture_.acquisition_frames(), 10);
  EXPECT_GT(capture_.acquisition_frames(), 0);
  for (int frame = 10; frame < 40; ++frame) {
    const CaptureResult& result = See(person, frame);
    ASSERT_EQ(result.state, CaptureState::kTracking) << "frame " << frame;
    EXPECT_LT(MeanError(person, Stroll(person, frame), result), 70) << "frame " << frame;
  }
  // Without outlines, sizes stay those of a first guess, and guesses are 6 % apart.
  EXPECT_NEAR(capture_.body().sizes().Stature(), 1750, 0.075 * 1750);
}

TEST_P(Capture, MeasuresAPersonByOutlines) {
  const BodyModel person(table_, AverageSizes(1750));
  const RoundStudio studio;
  for (int frame = 0; frame < 15; ++frame) {
    const auto seen = studio.Carve(person, Stroll(person, frame));
    capture_.Update({seen.hull, seen.outlines}, NextNs());
  }
  EXPECT_NEAR(capture_.body().sizes().Stature(), 1750, 30);
}

TEST_P(Capture, SaysThatNobodyIsThereAndMeasuresTheNextPersonAnew) {
  const BodyModel tall(table_, AverageSizes(1850));
  const BodyModel child(table_, AverageSizes(1300));
  for (int frame = 0; frame < 12; ++frame) See(tall, frame);
  const double tall_mm = capture_.body().sizes().Stature();
  for (int frame = 0; frame < 40; ++frame) SeeNobody();
  EXPECT_EQ(SeeNobody().state, CaptureState::kSearching);
  for (int frame = 0; frame < 12; ++frame) See(child, frame);
  EXPECT_EQ(See(child, 12).state, CaptureState::kTracking);
  EXPECT_LT(capture_.body().sizes().Stature(), tall_mm - 300);
}

TEST_P(Capture, TellsHowSureItIsOfWhoeverIsSeen) {
  EXPECT_FALSE(SeeNobody().probability);
  const BodyModel person(table_, AverageSizes(1750));
  for (int frame = 0; frame < 12; ++frame) {
    const CaptureResult& result = See(person, frame);
    ASSERT_TRUE(result.probability) << "frame " << frame;
    const double rivals = result.rival ? result.rival->probability : 0;
    EXPECT_GT(*result.probability, 0) << "frame " << frame;
    EXPECT_LE(*result.probability + rivals, 1 + 1e-12) << "frame " << frame;
  }
  EXPECT_FALSE(SeeNobody().probability) << "the person is lost";
}

TEST_P(Capture, KeepsTheBodyOfAPersonWhoWasGoneForAMoment) {
  const BodyModel person(table_, AverageSizes(1750));
  for (int frame = 0; frame < 12; ++frame) See(person, frame);
  const double before = capture_.body().sizes().Stature();
  EXPECT_EQ(SeeNobody().state, CaptureState::kLost);
  for (int frame = 12; frame < 16; ++frame) See(person, frame);
  EXPECT_EQ(See(person, 16).state, CaptureState::kTracking);
  EXPECT_EQ(capture_.body().sizes().Stature(), before);
}

TEST_P(Capture, MeasuresWhoeverIsThereInsteadOfAPersonWhoWasLost) {
  const BodyModel tall(table_, AverageSizes(1850));
  const BodyModel child(table_, AverageSizes(1300));
  for (int frame = 0; frame < 12; ++frame) See(tall, frame);
  const double tall_mm = capture_.body().sizes().Stature();
  EXPECT_EQ(SeeNobody().state, CaptureState::kLost);
  for (int frame = 12; frame < 60; ++frame) See(child, frame);
  EXPECT_EQ(See(child, 60).state, CaptureState::kTracking);
  EXPECT_LT(capture_.body().sizes().Stature(), tall_mm - 300);
}

TEST_P(Capture, GivesTheSameBitsForTheSameVoxels) {
  const BodyModel person(table_, AverageSizes(1600));
  const std::unique_ptr<MotionCapture> again = MakeSurfaceCapture(table_);
  for (int frame = 0; frame < 8; ++frame) {
    const VoxelGrid grid = Voxelize(person, Stroll(person, frame), 25);
    const std::int64_t now_ns = NextNs();
    const CaptureResult first = capture_.Update({grid, {}}, now_ns);
    const CaptureResult second = again->Update({grid, {}}, now_ns);
    ASSERT_EQ(first.state, second.state);
    ASSERT_EQ(first.points_W, second.points_W);
    ASSERT_EQ(first.point_std_mm, second.point_std_mm);
  }
}

TEST(GivenSizes, HoldForThePersonWhomTheyFitAlone) {
  const BodyTable table = LoadBodyTable("full");
  const BodyModel adult(table, AverageSizes(1900));
  const RoundStudio studio;
  const std::unique_ptr<MotionCapture> capture = MakeSurfaceCapture(table);
  capture->Expect(AverageSizes(1600));
  for (int frame = 0; frame < 4; ++frame) {
    const auto [hull, outlines] = studio.Carve(adult, Stroll(adult, frame));
    EXPECT_NE(capture->Update({hull, outlines}, frame * kFrameNs).state, CaptureState::kTracking);
  }
}

// While sizes are still measured too; only to look for somebody takes memory.
// As of trousers in the floor's colour.
TEST(DefaultBody, IsFoundThoughTwoCamerasDoNotSeeItsLegs) {
  const BodyTable table = LoadBodyTable("full");
  const BodyModel person(table, AverageSizes(1750));
  const RoundStudio studio;
  const std::unique_ptr<MotionCapture> capture = MakeSurfaceCapture(table);
  for (int frame = 0; frame < 8; ++frame) {
    const PoseState pose = Stroll(person, frame);
    std::vector<PosedCapsule> all, trunk;
    person.PoseShape(person.PostureAt(pose), all);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!IsLeg(person.shape()[i].part)) trunk.push_back(all[i]);
    const auto seen = studio.CarveAsSeen({trunk, all, all, trunk, all, all}, 100);
    const Eigen::AlignedBox3d box_W(seen.hull.origin_W() - Vector3(300, 300, 0),
                                    seen.hull.end_W() + Vector3(300, 300, 0));
    const Eigen::AlignedBox3d to_floor_W(Vector3(box_W.min().x(), box_W.min().y(), 0), box_W.max());
    const CaptureResult& result =
        capture->Update({seen.hull, seen.outlines, to_floor_W}, (frame + 1) * kFrameNs, nullptr);
    if (frame < 6) continue;
    ASSERT_EQ(result.state, CaptureState::kTracking);
    EXPECT_LT(MeanError(person, pose, result), 50);
  }
}

TEST(DefaultBody, IsFollowedWithoutAllocatingOnceItRuns) {
  if (!kCountsAllocations) GTEST_SKIP() << "the sanitizer allocates by itself";
  const BodyTable table = LoadBodyTable("full");
  const BodyModel person(table, AverageSizes(1750));
  const RoundStudio studio;
  std::vector<RoundStudio::CarvedBody> seen;
  for (int frame = 0; frame < 4; ++frame) {
    seen.push_back(studio.Carve(person, Stroll(person, frame)));
  }
  const std::unique_ptr<MotionCapture> capture = MakeSurfaceCapture(table);
  std::int64_t now_ns = 0;
  const auto walk_to_and_fro = [&] {
    for (const int frame : {0, 1, 2, 3, 2, 1}) {
      capture->Update({seen[frame].hull, seen[frame].outlines}, now_ns += kFrameNs);
    }
  };
  for (int i = 0; i < 6; ++i) walk_to_and_fro();
  EXPECT_GT(capture->acquisition_frames(), 0);
  const std::int64_t before = Allocations();
  EXPECT_GT(before, 0);
  walk_to_and_fro();
  EXPECT_EQ(Allocations() - before, 0);
}

INSTANTIATE_TEST_SUITE_P(Tables, Capture, ::testing::Values("mikic2003", "full"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace mocap
