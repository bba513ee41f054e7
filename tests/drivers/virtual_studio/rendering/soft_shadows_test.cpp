#include "drivers/virtual_studio/rendering/soft_shadows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "drivers/virtual_studio/room/room_plan.h"
#include "drivers/virtual_studio/scene.h"
#include "tests/support/pixels.h"

namespace mocap::simulation {
namespace {

SimulatedStudioOptions PlainStudio() {
  SimulatedStudioOptions options = RecordedSimulation();
  options.motion = "stand";
  options.width_px = 320;
  options.height_px = 240;
  return options;
}

/// Pixels of all cameras that a shadow darkens.
struct Fallen {
  int on_floor = 0, elsewhere = 0;
  double least_light = 1;
};

/// The shadow of somebody who stands, moved by an offset.
Fallen ShadowAt(const Eigen::Vector3f& offset_W) {
  const SimulatedStudioOptions options = PlainStudio();
  const auto scene = std::make_shared<const Scene>(options);
  const PersonMesh& mesh = scene->figures().front().mesh;
  std::vector<Eigen::Vector3f> p_W, n_W;
  SkinMesh(mesh, scene->people().front().BonesAt(options.start_ns), p_W, n_W);
  for (Eigen::Vector3f& p : p_W) p += offset_W;
  Fallen fallen;
  for (int camera = 0; camera < options.cameras; ++camera) {
    const SceneView view(scene, camera);
    const EmptyView& empty = view.fixed_view();
    SoftShadows shadows(view.calibration());
    shadows.SetView(empty, view.calibration().X_CW);
    shadows.Cast(mesh, p_W);
    Image<Bgr> canvas = empty.image;
    const PixelBox box = shadows.Darken(canvas);
    for (int y = 0; y < canvas.height(); ++y)
      for (int x = 0; x < canvas.width(); ++x) {
        const int before = empty.image(x, y).g, after = canvas(x, y).g;
        EXPECT_LE(after, before);
        if (after == before) continue;
        EXPECT_TRUE(x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1) << x << ' ' << y;
        (empty.floor(x, y).x == kNoFloor ? fallen.elsewhere : fallen.on_floor) += 1;
        fallen.least_light = std::min(fallen.least_light, (after + 1.0) / before);
      }
  }
  return fallen;
}

TEST(SoftShadows, FallOnTheFloorAndNearAWallOnTheWall) {
  const Fallen middle = ShadowAt({0, 0, 0}),
               near_wall = ShadowAt({float(kRoomX_mm) / 2 - 400, 0, 0});
  EXPECT_GT(middle.on_floor, 1000);
  EXPECT_LT(middle.elsewhere, middle.on_floor / 20);
  EXPECT_GT(near_wall.on_floor, 50);
  EXPECT_GT(near_wall.elsewhere, 500);
  // Ambient light remains.
  EXPECT_GT(middle.least_light, 0.6);
  EXPECT_LT(middle.least_light, 0.75);
}

TEST(SoftShadows, ArePaleAndWideWhereAHeadCastsThem) {
  // Up there, hardly anything of a panel is hidden at once.
  const Fallen standing = ShadowAt({0, 0, 0}), raised = ShadowAt({0, 0, 600});
  EXPECT_GT(raised.least_light, standing.least_light + 0.03);
  EXPECT_GT(raised.on_floor + raised.elsewhere, standing.on_floor + standing.elsewhere);
}

TEST(SoftShadows, OfSomebodyInTheCorridorDoNotPassTheWall) {
  const Fallen outside = ShadowAt({float(kDoorX_mm) - 700, 0, 0});
  EXPECT_EQ(outside.on_floor + outside.elsewhere, 0);
}

// The canvas is repaired, not redrawn, from frame to frame.
TEST(SoftShadows, OfAPictureDoNotDependOnThoseBefore) {
  SimulatedStudioOptions options = PlainStudio();
  options.motion = "run";
  options.soft_shadows = true;
  options.contrast = 20;
  options.misled_share = 0.5;
  const auto scene = std::make_shared<const Scene>(options);
  for (int camera = 0; camera < options.cameras; ++camera) {
    const auto view = std::make_shared<const SceneView>(scene, camera);
    ScenePainter steady(view), fresh(view);
    for (int frame = 0; frame <= 20; ++frame) steady.Paint(scene->CaptureTime(camera, frame));
    fresh.Paint(scene->CaptureTime(camera, 20));
    EXPECT_EQ(Pixels(steady.picture().view()), Pixels(fresh.picture().view())) << camera;
  }
}

}  // namespace
}  // namespace mocap::simulation
