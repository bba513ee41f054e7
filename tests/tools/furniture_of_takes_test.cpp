// People who hardly move, as simulated studios show them, are not named as furniture.
#include <gtest/gtest.h>

#include <string>

#include "config/open_studio.h"
#include "core/reconstruction/empty_room/furniture_watch.h"
#include "core/reconstruction/empty_room/mean_picture.h"
#include "core/reconstruction/empty_room/steady_picture.h"
#include "tests/support/run_command.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate.h"

namespace mocap {
namespace {

class StillPeople : public ::testing::TestWithParam<const char*> {};

TEST_P(StillPeople, AreNoFurniture) {
  const testing::TemporaryFolder folder;
  const std::string take = folder.path() / "take";
  ::testing::internal::CaptureStdout();
  testing::RunCommand(AddSimulateCommand,
                      "simulate --width 320 --height 240 --cameras 2 --seconds 180 --fps 1 --out " +
                          take + " --motion " + GetParam());
  ::testing::internal::GetCapturedStdout();
  Studio studio = OpenTake(take, {});
  for (StudioCamera& camera : studio.cameras) {
    MeanPicture mean;
    for (const BackgroundFrame& frame : camera.background()) mean.Add(frame.image);
    FurnitureWatch watch({Smooth(mean.Mean().view()), {}}, 320 * 240 / 2000);
    camera.driver->Start();
    Frame frame;
    std::size_t most = 0;
    for (int i = 0; camera.driver->Grab(frame, std::chrono::milliseconds(0)) == GrabStatus::kFrame;
         ++i) {
      if (i % 2 == 0) most = std::max(most, watch.Add(frame.image, frame.capture_ns).size());
    }
    EXPECT_EQ(most, 0u) << camera.calibration.name;
    camera.driver->Stop();
  }
}

INSTANTIATE_TEST_SUITE_P(FurnitureOfTakes, StillPeople,
                         ::testing::Values("sit", "stand", "gesture"));

}  // namespace
}  // namespace mocap
