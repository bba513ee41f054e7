#include "daemon/status/light_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mocap {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t kSecondNs = 1'000'000'000;

class LightWatchTest : public ::testing::Test {
 protected:
  LightWatchTest() {
    for (const char* name : {"cam1", "cam2"}) {
      CameraStatus camera;
      camera.name = name;
      camera.state = CameraState::kStreaming;
      status_.cameras.push_back(camera);
    }
  }

  std::optional<LightChange> After(double light) {
    for (CameraStatus& camera : status_.cameras) camera.light = light;
    return watch_.Add(status_, ++seconds_ * kSecondNs);
  }

  PipelineStatus status_;
  LightWatch watch_;
  std::int64_t seconds_ = 0;
};

TEST_F(LightWatchTest, ALampThatIsSwitchedIsToldForAMinute) {
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(After(1));
  const auto change = After(1.4);
  ASSERT_TRUE(change);
  EXPECT_NEAR(change->factor, 1.4, 1e-9);
  EXPECT_THAT(change->cameras, ElementsAre("cam1", "cam2"));
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(After(1.4)) << i;
  EXPECT_FALSE(After(1.4));
}

TEST_F(LightWatchTest, EveningIsNotSudden) {
  double light = 1;
  for (int i = 0; i < 300; ++i) EXPECT_FALSE(After(light *= 0.99));
  EXPECT_LT(light, 0.1);
}

TEST_F(LightWatchTest, LearningTheStudioInAnotherLightIsNoChangeOfLight) {
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(After(1.4));
  for (CameraStatus& camera : status_.cameras) ++camera.replacements;
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(After(1));
}

TEST_F(LightWatchTest, ACameraThatWasAwayStartsAnew) {
  After(1);
  status_.cameras[0].state = CameraState::kLost;
  status_.cameras[1].state = CameraState::kLost;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(After(1));
  for (CameraStatus& camera : status_.cameras) camera.state = CameraState::kStreaming;
  EXPECT_FALSE(After(2));
}

}  // namespace
}  // namespace mocap
