#include "tools/stream/streamed_bones.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/posed_people.h"

namespace mocap {
namespace {

using testing::BodyMessage;
using testing::PoseMessage;
using testing::RandomPose;

/// What is told of somebody in a pose.
class StreamedBonesTest : public ::testing::Test {
 protected:
  std::optional<HumanoidPose> BonesOf(const BodyModel& body, const body_t& message) {
    const pose_t pose = PoseMessage(body, RandomPose(body, 1), 1);
    return bones_.Of({.message = pose, .is_tracked = true, .body = &message});
  }
  std::optional<HumanoidPose> BonesOf(const BodyModel& body) {
    return BonesOf(body, BodyMessage(body));
  }

  const BodyModel body_{LoadBodyTable("full"), AverageSizes(1700)};
  StreamedBones bones_;
};

void ExpectSame(const HumanoidPose& one, const HumanoidPose& other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_TRUE(one[i].p.isApprox(other[i].p, 1e-9)) << kHumanoid[i].name;
    EXPECT_TRUE(one[i].R.isApprox(other[i].R, 1e-9)) << kHumanoid[i].name;
  }
}

TEST_F(StreamedBonesTest, AreThoseOfTheBodyThatIsTold) {
  const BodyModel taller(LoadBodyTable("full"), AverageSizes(1900));
  const BodyModel other(LoadBodyTable("mikic2003"), AverageSizes(1700));
  for (const BodyModel* body : {&body_, &taller, &other, &body_}) {
    const auto bones = BonesOf(*body);
    ASSERT_TRUE(bones);
    ExpectSame(*bones, HumanoidPoseOf(*body, RandomPose(*body, 1)));
  }
}

TEST_F(StreamedBonesTest, ABodyThatIsNotKnownOrNobodysHasNone) {
  ASSERT_TRUE(BonesOf(body_));
  body_t wrong = BodyMessage(body_);
  wrong.model = "/etc/passwd";
  EXPECT_FALSE(BonesOf(body_, wrong));
  for (const double size : {0.0, -5.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    wrong = BodyMessage(body_);
    wrong.size_mm[3] = size;
    EXPECT_FALSE(BonesOf(body_, wrong)) << size;
  }
  EXPECT_FALSE(
      BonesOf(body_, BodyMessage(BodyModel(LoadBodyTable("mikic2003"), AverageSizes(1700)))));
  EXPECT_TRUE(BonesOf(body_));
}

}  // namespace
}  // namespace mocap
