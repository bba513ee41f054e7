#include "daemon/pipeline/track_stage.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/surface_capture.h"
#include "tests/support/seen_body.h"

namespace mocap {
namespace {

constexpr std::int64_t kFrameNs = 33'333'333;

class LastNames : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override {
    names.clear();
    for (const PersonView& person : set.people) names.emplace_back(person.name);
  }
  std::vector<std::string> names;
};

/// Two people beside each other along x.
class TrackStageTest : public ::testing::Test {
 protected:
  TrackStageTest() {
    std::vector<PosedCapsule> flesh, one;
    for (const double x_mm : {-600.0, 500.0}) {
      const BodyModel body(table_, AverageSizes(1750));
      PoseState pose;
      pose.X_WT.p =
          Vector3(x_mm, 0, body.sizes().torso / 2 + body.sizes().thigh + body.sizes().calf);
      const ArmStance arm{.raise = -70, .elbow = 25};
      pose.theta = AnglesOf({.arm_l = arm, .arm_r = arm}, table_);
      const Posture posture = body.PostureAt(pose);
      const BodyPoints points_W = body.PointsAt(posture);
      people_W_.extend(points_W.rowwise().minCoeff());
      people_W_.extend(points_W.rowwise().maxCoeff());
      body.PoseShape(posture, one);
      flesh.insert(flesh.end(), one.begin(), one.end());
    }
    seen_ = studio_.Carve(flesh, 200);
  }
  void See(int frames) {
    for (int i = 0; i < frames; ++i) {
      CarvedSet set;
      set.grid = seen_.hull;
      set.outlines = seen_.outlines;
      set.eyes = studio_.Eyes();
      set.capture_ns = now_ns_ += kFrameNs;
      stage_.Process(set);
    }
  }

  const BodyTable table_ = LoadBodyTable("full");
  const RoundStudio studio_;
  RoundStudio::CarvedBody seen_;
  Eigen::AlignedBox3d people_W_;  // Around both, truly.
  LastNames sink_;
  StageRecorders recorders_;
  const std::shared_ptr<SubjectPosition> position_ = std::make_shared<SubjectPosition>();
  TrackStage stage_{PeopleCapture([this] { return MakeSurfaceCapture(table_); }, {.most = 4}),
                    LatencyOrigin::kArrival, sink_, recorders_, position_};
  std::int64_t now_ns_ = 1'000'000'000'000;
};

TEST_F(TrackStageTest, HeadsAreToldTheMiddleOfAllWhoAreFollowed) {
  EXPECT_FALSE(position_->Told());
  See(5);
  ASSERT_EQ(sink_.names.size(), 2u);
  ASSERT_TRUE(position_->Told());
  EXPECT_LT((*position_->Told() - people_W_.center()).norm(), 60);
}

TEST_F(TrackStageTest, APersonIsCalledAsWasAskedFor) {
  See(5);
  EXPECT_EQ(sink_.names, (std::vector<std::string>{"", ""}));
  stage_.NamePerson(2, "anna");
  See(1);
  EXPECT_EQ(sink_.names, (std::vector<std::string>{"", "anna"}));
}

}  // namespace
}  // namespace mocap
