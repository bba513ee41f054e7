#include "drivers/head_follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "drivers/simulation/simulated_head.h"

namespace mocap {
namespace {

constexpr std::int64_t kFrame_ns = 33'333'333;
constexpr double kFrame_s = 1e-9 * kFrame_ns;

/// A head at the origin that looks along x; its angles are those of the world.
class Following : public ::testing::Test {
 protected:
  Following() {
    camera_.X_CW.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    camera_.X_CW.p.setZero();
    camera_.head.emplace();
    camera_.head->tilt_axis_W = -Vector3::UnitY();
  }

  HeadFollower Follower(const PanTiltLimits& range = {{-9, -9}, {9, 9}}) {
    return {camera_, range, person_};
  }

  /// Shows so many frames. @return  the fastest pan between two of them [rad/s].
  double Run(HeadFollower& follower, int frames) {
    double fastest = 0;
    for (int i = 0; i < frames; ++i) {
      const PanTiltAngles before = head_.At(now_ns_);
      now_ns_ += kFrame_ns;
      head_.Advance(now_ns_);
      const PanTiltAngles now = head_.At(now_ns_);
      fastest = std::max(fastest, std::abs(now.pan_rad - before.pan_rad) / kFrame_s);
      follower.Follow(head_, now, now_ns_);
    }
    return fastest;
  }

  double Pan() const { return head_.At(now_ns_).pan_rad; }

  CameraCalibration camera_;
  std::shared_ptr<SubjectPosition> person_ = std::make_shared<SubjectPosition>();
  SimulatedHead head_{{{-1, -0.5}, {1, 0.5}}};
  std::int64_t now_ns_ = 1'000'000'000'000;
};

Vector3 AtPan(double pan_rad) { return {3000 * std::cos(pan_rad), 3000 * std::sin(pan_rad), 0}; }

TEST_F(Following, RestsWhileNobodyIsFollowed) {
  HeadFollower follower = Follower();
  EXPECT_EQ(Run(follower, 30), 0);
  person_->Tell(AtPan(0.5));
  person_->Tell(std::nullopt);
  EXPECT_EQ(Run(follower, 30), 0);
}

TEST_F(Following, RestsWhileThePersonIsNearTheMiddle) {
  HeadFollower follower = Follower();
  person_->Tell(AtPan(0.9 * HeadFollower::kSlack_rad));
  EXPECT_EQ(Run(follower, 30), 0);
}

TEST_F(Following, IsDrawnUntilThePersonIsNearTheMiddle) {
  HeadFollower follower = Follower();
  person_->Tell(AtPan(0.5));
  Run(follower, 60);
  EXPECT_NEAR(Pan(), 0.5 - HeadFollower::kSlack_rad, 1e-3);
  // Trembling about there does not move it.
  for (const double tremble : {0.02, -0.02, 0.01}) {
    person_->Tell(AtPan(0.48 + tremble));
    EXPECT_NEAR(Run(follower, 15), 0, 1e-3);
  }
}

TEST_F(Following, IsNoFasterThanPicturesStaySharp) {
  HeadFollower follower = Follower();
  Run(follower, 10);
  person_->Tell(AtPan(0.95));
  Run(follower, 15);
  // Half a second, of which the first step begins within a tenth.
  EXPECT_LE(Pan(), 0.5 * HeadFollower::kFastest_rad_s + 0.1);
  EXPECT_GT(Pan(), 0.3);
}

TEST_F(Following, StaysWithinTheHeadsLimitsAndTheStudios) {
  HeadFollower anywhere = Follower(), narrow = Follower({{-0.3, -0.1}, {0.3, 0.1}});
  person_->Tell(AtPan(1.4));
  Run(anywhere, 90);
  EXPECT_NEAR(Pan(), 1, 1e-9);
  person_->Tell(AtPan(-1.4));
  Run(narrow, 90);
  EXPECT_NEAR(Pan(), -0.3, 1e-9);
}

TEST(SimulatedHead, TakesItsTimeAndTellsWherePicturesAreTaken) {
  SimulatedHead head({{-1, -0.5}, {1, 0.5}});
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  head.Advance(5 * kSecond_ns);
  EXPECT_TRUE(head.TurnTo({1, -0.15}));
  EXPECT_EQ(head.At(5 * kSecond_ns), PanTiltAngles{});
  EXPECT_NEAR(head.At(5 * kSecond_ns + kSecond_ns / 5).pan_rad, 0.2 * SimulatedHead::kSpeed_rad_s,
              1e-9);
  EXPECT_EQ(head.At(7 * kSecond_ns), (PanTiltAngles{1, -0.15}));
  EXPECT_FALSE(head.TurnTo({1.1, 0}));
}

TEST(SubjectPosition, TellsWhatItWasTold) {
  SubjectPosition person;
  EXPECT_FALSE(person.Told());
  person.Tell(Vector3(1200.4, -3000, 50000));
  EXPECT_EQ(*person.Told(), Vector3(1200, -3000, 32000));
  person.Tell(std::nullopt);
  EXPECT_FALSE(person.Told());
}

}  // namespace
}  // namespace mocap
