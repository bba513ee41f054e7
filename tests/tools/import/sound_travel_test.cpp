// What the place of a sound is worth.
#include "tools/import/sound_travel.h"

#include <gtest/gtest.h>

#include "tests/support/box_take.h"

namespace mocap {
namespace {

std::vector<CameraCalibration> Around(double farther_mm) {
  std::vector<CameraCalibration> cameras;
  for (const Vector3& direction :
       {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(-1, 0, 0), Vector3(0, -1, 0)})
    cameras.push_back(testing::CameraAt("cam" + std::to_string(cameras.size() + 1), direction));
  cameras[0].X_CW.p.z() += farther_mm;
  return cameras;
}

TEST(SoundTravel, IsAboutAMetreForAnUnknownPlace) {
  // The distance to a place 1 m from the middle varies by 1 m cos: 0.7 m, or 2.1 ms.
  for (const SoundTravel& travel : SoundTravels(Around(0)))
    EXPECT_NEAR(travel.sigma_s, 0.0021, 0.0003);
}

TEST(SoundTravel, TakesThreeMillisecondsForAMetre) {
  // The axes still meet in the middle: the camera has moved along its own.
  const auto near = SoundTravels(Around(0)), far = SoundTravels(Around(3430));
  EXPECT_NEAR(far[0].from_middle_s - near[0].from_middle_s, 0.01, 1e-6);
  EXPECT_NEAR(far[1].from_middle_s, near[1].from_middle_s, 1e-6);
}

}  // namespace
}  // namespace mocap
