#include "drivers/simulation/picture_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>

#include "drivers/simulation/simulated_studio.h"
#include "drivers/virtual_studio/scene.h"
#include "tests/support/pixels.h"

namespace mocap {
namespace {

TEST(PictureAhead, ACameraInRealTimeGivesThePicturesOfTheirTimes) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.width_px = 320;
  options.height_px = 240;
  options.seconds = 1;
  options.start_ns = 0;
  options.realtime = true;
  options.fps = 100;
  const auto scene = std::make_shared<const simulation::Scene>(options);
  simulation::ScenePainter painter(std::make_shared<const simulation::SceneView>(scene, 0));
  const SimulatedStudio studio(options);
  const auto camera = studio.OpenCamera(0);
  for (int session = 0; session < 2; ++session) {
    camera->Start();
    for (int i = 0; i < 10; ++i) {
      Frame frame;
      ASSERT_EQ(camera->Grab(frame, std::chrono::milliseconds(1000)), GrabStatus::kFrame);
      painter.Paint(frame.capture_ns);
      EXPECT_EQ(Pixels(frame.image), Pixels(painter.picture().view()));
      const ImageView<const std::uint8_t> mask = camera->TrueMask();
      EXPECT_EQ(std::count(mask.row(0), mask.row(0) + mask.width() * mask.height(), 255),
                std::ranges::count_if(painter.figures().pixels(), [](int m) { return m != 0; }));
    }
    camera->Stop();
  }
}

TEST(PictureAhead, APictureThatIsBeingPaintedIsWaitedForOrLeft) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.width_px = 320;
  options.height_px = 240;
  const auto view = std::make_shared<const simulation::SceneView>(
      std::make_shared<const simulation::Scene>(options), 0);
  simulation::PictureAhead ahead(view);
  simulation::ScenePainter expected(view);
  auto painter = std::make_unique<simulation::ScenePainter>(view);
  for (int i = 0; i < 20; ++i) {
    const std::int64_t capture_ns = options.start_ns + i * 10'000'000;
    ahead.Ask(capture_ns);
    EXPECT_FALSE(ahead.Take(capture_ns + 1, painter));
    // Where the thread may not be brought forward, a picture is painted twice.
    if (!ahead.Take(capture_ns, painter)) painter->Paint(capture_ns);
    expected.Paint(capture_ns);
    EXPECT_EQ(Pixels(painter->picture().view()), Pixels(expected.picture().view()));
  }
}

}  // namespace
}  // namespace mocap
