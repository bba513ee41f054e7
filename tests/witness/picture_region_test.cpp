#include "tools/witness/picture_region.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace mocap {
namespace {

/// Looks along y of the room from 4 m away, turned about its axis.
struct Onlooker {
  explicit Onlooker(double roll_rad = 0) {
    camera.width_px = 640;
    camera.height_px = 480;
    OpenCvLens lens;
    lens.K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
    camera.lens = lens;
    Matrix3 R;
    R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    camera.X_CW = {ExpRotation({0, 0, roll_rad}) * R,
                   ExpRotation({0, 0, roll_rad}) * Vector3(0, 1000, 4000)};
  }
  CameraCalibration camera;
};

const std::vector<PosedCapsule> kPole = {{{0, 0, 300}, {0, 0, 1700}, 100, 100}};

TEST(PictureRegion, OfABodyIsItsBox) {
  const Onlooker from;
  const auto seen = SeeBody(kPole, from.camera, from.camera.X_CW);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->in_picture, 1);
  EXPECT_EQ(seen->box.turns, 0);
  EXPECT_NEAR(seen->box.middle_px.x(), 320, 1e-6);
  EXPECT_NEAR(seen->box.middle_px.y(), 240, 1e-6);
  EXPECT_NEAR(seen->box.height_px, 200, 1e-6) << "1600 mm at 4 m";
  EXPECT_NEAR(seen->box.width_px, 25, 1e-6);
  const PictureRegion square = RegionAround(seen->box, 1);
  EXPECT_NEAR(square.width_px, 250, 1e-6);
  EXPECT_NEAR(square.height_px, 250, 1e-6);
  EXPECT_NEAR(RegionAround(seen->box, 0.75).width_px, 187.5, 1e-6);
}

TEST(PictureRegion, IsUprightWhereverTheCamerasUpIs) {
  for (int turns = 0; turns < 4; ++turns) {
    // A camera turned to the right shows people turned to the left.
    const Onlooker from(-turns * std::numbers::pi / 2);
    const auto seen = SeeBody(kPole, from.camera, from.camera.X_CW);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->box.turns, turns);
    EXPECT_GT(seen->box.height_px, 2 * seen->box.width_px);
    const CropMap map = MapOf(RegionAround(seen->box, 1), 256, 256);
    const auto px = PixelFromNormalized(from.camera.lens,
                                        (from.camera.X_CW * Vector3(0, 0, 1700)).hnormalized());
    ASSERT_TRUE(px);
    const Vector2 head_px = map.turn_and_scale.inverse() * (*px - map.origin_px);
    EXPECT_NEAR(head_px.x(), 127.5, 1e-6);
    EXPECT_NEAR(head_px.y(), 127.5 - 87.5 / 250 * 256, 1e-6);
  }
}

TEST(PictureRegion, CountsWhatIsOutsideOfThePicture) {
  Onlooker from;
  from.camera.height_px = 240;
  const auto seen = SeeBody(kPole, from.camera, from.camera.X_CW);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->in_picture, 0.5);
  from.camera.X_CW.p.z() = -4000;
  EXPECT_FALSE(SeeBody(kPole, from.camera, from.camera.X_CW)) << "behind the camera";
}

TEST(PictureRegion, MapsPixelsOntoThemselvesAtTheirSize) {
  const CropMap map =
      MapOf({.middle_px = {127.5, 127.5}, .width_px = 256, .height_px = 256}, 256, 256);
  EXPECT_TRUE((map * Vector2(10, 20)).isApprox(Vector2(10, 20)));
}

}  // namespace
}  // namespace mocap
