#include "tools/take_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/setup_error.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"
#include "tools/calibration/footage.h"
#include "tools/camera_health.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;

/// A take whose first camera delivered nothing.
void WriteTake(const std::filesystem::path& folder) {
  const testing::SmallTake take;
  TakeWriter writer(folder, SmallDescription(take));
  for (int camera = 0; camera < take.cameras; ++camera) {
    for (int frame = 0; frame < 12; ++frame) {
      const Image<Bgr> picture = SmallPicture(take, camera, frame);
      writer.WriteBackground(camera, picture.view(), take.TimeNs(camera, frame));
      if (camera > 0) writer.WriteFrame(camera, picture.view(), take.TimeNs(camera, frame));
    }
  }
  writer.Finish();
}

TEST(TakeSamples, KeepTheCalibrationOfACameraThatDeliveredNothing) {
  const testing::TemporaryFolder folder;
  WriteTake(folder.path() / "take");
  const std::vector<SampleRequest> moments = ChooseHealthMoments(folder.path() / "take", 0, 10, 2);
  ASSERT_EQ(moments.size(), 2u);
  const TakeSamples samples = SampleTake(folder.path() / "take", moments, 50);
  EXPECT_THAT(samples.cameras, ElementsAre(Field(&CameraCalibration::name, "cam2"),
                                           Field(&CameraCalibration::name, "cam3"),
                                           Field(&CameraCalibration::name, "cam1")));
  EXPECT_TRUE(samples.moments[0].views[0]);
  EXPECT_FALSE(samples.moments[0].views[2]);
}

TEST(TakeSamples, FootageHasOnlyCamerasThatDelivered) {
  const testing::TemporaryFolder folder;
  WriteTake(folder.path() / "take");
  EXPECT_THAT(
      OpenFootage(folder.path() / "take").cameras,
      ElementsAre(Field(&FootageCamera::name, "cam2"), Field(&FootageCamera::name, "cam3")));
}

TEST(TakeSamples, MoreCamerasThanAreCarvedAreRefusedByTheTakesName) {
  const testing::TemporaryFolder folder;
  testing::WriteSmallTake(folder.path() / "take", {.cameras = 65, .frames = 1});
  EXPECT_EQ(testing::SetupErrorOf([&] { SampleTake(folder.path() / "take", {}, 50); }),
            "small: has 65 cameras; expected 1 to 64");
}

}  // namespace
}  // namespace mocap
