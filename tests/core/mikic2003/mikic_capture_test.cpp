#include "core/mikic2003/mikic_capture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "tests/core/mikic2003/paper_person.h"

namespace mocap::mikic2003 {
namespace {

constexpr std::int64_t kFrameNs = 100'000'000;

// Somebody who steps on the spot and swings bent arms, at the paper's 10 Hz.
Stance Stepping(int frame) {
  const double swing = std::sin(0.5 * frame);
  Stance stance = kSpread;
  stance.arm_l.forward = 20 * swing;
  stance.arm_r.forward = -20 * swing;
  stance.leg_l.hip = 10 + 10 * swing, stance.leg_l.knee = 25 + 15 * swing;
  stance.leg_r.hip = 10 - 10 * swing, stance.leg_r.knee = 25 - 15 * swing;
  return stance;
}

class Figure9 : public ::testing::Test {
 protected:
  PoseState Truth(int frame) const {
    return person_.Pose(Stepping(frame), 0.4, Vector3(60.0 * frame, 0, 1200));
  }
  const CaptureResult& See(int frame) {
    return capture_.Update({person_.Grid(Truth(frame)), {}}, frame * kFrameNs, nullptr);
  }
  double ErrorOf(const CaptureResult& result, int frame) const {
    return (result.points_W - person_.body.PointsAt(person_.body.PostureAt(Truth(frame))))
        .colwise()
        .norm()
        .mean();
  }

  PaperPerson person_;
  MikicCapture capture_{LoadBodyTable("mikic2003")};
};

TEST_F(Figure9, BodyIsAcquiredInAFewFramesAndThenTracked) {
  EXPECT_EQ(See(0).state, CaptureState::kAcquiring);
  int frame = 1;
  while (See(frame).state == CaptureState::kAcquiring && frame < 20) ++frame;
  // §8.1: "usually happens in three to four frames".
  EXPECT_LE(capture_.acquisition_frames(), 4);
  for (++frame; frame < 40; ++frame) {
    const CaptureResult& result = See(frame);
    ASSERT_EQ(result.state, CaptureState::kTracking);
    EXPECT_LT(ErrorOf(result, frame), 70) << "frame " << frame;
  }
}

TEST_F(Figure9, SizesStayOnceTheyHaveSettled) {
  int frame = 0;
  while (See(frame).state != CaptureState::kTracking && frame < 20) ++frame;
  const BodySizes settled = capture_.body().sizes();
  for (++frame; frame < 30; ++frame) EXPECT_FALSE(See(frame).body_changed);
  EXPECT_EQ(capture_.body().sizes(), settled);
}

TEST_F(Figure9, KnownSizesAreNotMeasured) {
  capture_.Expect(person_.body.sizes());
  EXPECT_EQ(See(0).state, CaptureState::kTracking);
  See(1);
  EXPECT_EQ(capture_.body().sizes(), person_.body.sizes());
}

TEST_F(Figure9, SameVoxelsGiveTheSameBits) {
  MikicCapture again(LoadBodyTable("mikic2003"));
  for (int frame = 0; frame < 6; ++frame) {
    const VoxelGrid grid = person_.Grid(Truth(frame));
    const CaptureResult first = capture_.Update({grid, {}}, frame * kFrameNs, nullptr);
    const CaptureResult second = again.Update({grid, {}}, frame * kFrameNs, nullptr);
    EXPECT_EQ(first.points_W, second.points_W);
  }
}

TEST_F(Figure9, WhoIsLostIsLocatedAgainWithTheSameSizes) {
  int frame = 0;
  while (See(frame).state != CaptureState::kTracking && frame < 20) ++frame;
  const BodySizes settled = capture_.body().sizes();
  // Meanwhile the person has turned by 100 degrees and walked away.
  const auto elsewhere = [&](int later) {
    return person_.Pose(Stepping(later), 2.1, Vector3(1500, 900, 1200));
  };
  bool was_lost = false;
  CaptureResult result;
  for (int later = frame + 1; later < frame + 8; ++later) {
    result = capture_.Update({person_.Grid(elsewhere(later)), {}}, later * kFrameNs, nullptr);
    was_lost = was_lost || result.state == CaptureState::kLost;
    frame = later;
    if (was_lost && result.state == CaptureState::kTracking) break;
  }
  EXPECT_TRUE(was_lost);
  EXPECT_EQ(result.state, CaptureState::kTracking);
  const BodyPoints truth_W = person_.body.PointsAt(person_.body.PostureAt(elsewhere(frame)));
  EXPECT_LT((result.points_W - truth_W).colwise().norm().mean(), 100);
  EXPECT_EQ(capture_.body().sizes(), settled);
}

TEST_F(Figure9, WhoNeverFitsIsForgottenAfterASecond) {
  capture_.Expect(PaperPerson::SizesOf(1000));
  bool was_lost = false, was_forgotten = false;
  for (int frame = 0; frame < 30 && !was_forgotten; ++frame) {
    const CaptureState state = See(frame).state;
    was_lost = was_lost || state == CaptureState::kLost;
    was_forgotten = was_lost && state == CaptureState::kSearching;
  }
  EXPECT_TRUE(was_forgotten);
}

TEST_F(Figure9, WhoIsGoneForASecondIsForgotten) {
  for (int frame = 0; frame < 12; ++frame) See(frame);
  VoxelGrid nothing;
  nothing.Reset({0, 0, 0}, {0, 0, 0}, 25);
  EXPECT_EQ(capture_.Update({nothing, {}}, 12 * kFrameNs, nullptr).state, CaptureState::kLost);
  for (int frame = 13; frame < 25; ++frame) {
    capture_.Update({nothing, {}}, frame * kFrameNs, nullptr);
  }
  EXPECT_EQ(capture_.Update({nothing, {}}, 25 * kFrameNs, nullptr).state, CaptureState::kSearching);
}

TEST(MikicCaptureBody, IsThePapersAlone) {
  EXPECT_NO_THROW(RequirePaperAxes(LoadBodyTable("mikic2003")));
  EXPECT_THROW(RequirePaperAxes(LoadBodyTable("full")), SetupError);
}

}  // namespace
}  // namespace mocap::mikic2003
