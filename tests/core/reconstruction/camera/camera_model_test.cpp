#include "core/reconstruction/camera/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/reconstruction/lenses.h"

namespace mocap {
namespace {

void ExpectNear(const std::optional<Vector2>& found, const Vector2& wanted, double tolerance) {
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->x(), wanted.x(), tolerance);
  EXPECT_NEAR(found->y(), wanted.y(), tolerance);
}

TEST(CameraModel, TsaiUndistortsAsComputedByHand) {
  TsaiLens lens = BarrelTsaiLens();
  lens.focal_mm = 6;
  lens.kappa1 = 0.004;
  lens.center_px = {320, 240};
  // Xd = 100 · 0.01 / 1.02, Yd = 100 · 0.0099, and both times (1 + 0.004 (Xd² + Yd²)) / 6.
  ExpectNear(NormalizedFromPixel(lens, {420, 340}), {0.1646674959, 0.1662812374}, 1e-9);
}

TEST(CameraModel, OpenCvLensProjectsLikeOpenCv) {
  const OpenCvLens lens{.K = PinholeMatrix(500, 510, 320, 240),
                        .distortion = {-0.37, 0.2, 0.001, -0.002, -0.07}};
  // cv::projectPoints of (0.3, -0.4, 1).
  ExpectNear(PixelFromNormalized(lens, {0.3, -0.4}), {457.28593750, 53.07862500}, 1e-6);
}

TEST(CameraModel, ALensOfEightCoefficientsProjectsLikeOpenCvsRationalModel) {
  OpenCvLens lens = RationalOpenCvLens();
  lens.K = PinholeMatrix(500, 510, 320, 240);
  // cv::projectPoints of (0.3, -0.4, 1) and (0.7, 0.5, 1).
  ExpectNear(PixelFromNormalized(lens, {0.3, -0.4}), {458.20898208, 52.07828436}, 1e-6);
  ExpectNear(PixelFromNormalized(lens, {0.7, 0.5}), {609.60298965, 451.50864960}, 1e-6);
}

TEST(CameraModel, FisheyeLensProjectsLikeOpenCv) {
  const FisheyeLens lens{.K = PinholeMatrix(500, 510, 320, 240),
                         .distortion = {-0.05, 0.02, -0.01, 0.003}};
  // cv::fisheye::distortPoints of (0.5, 1.2).
  ExpectNear(PixelFromNormalized(lens, {0.5, 1.2}), {490.30684421, 656.91115462}, 1e-6);
}

TEST(CameraModel, EveryPixelReturnsToItself) {
  for (const auto& [name, camera] : DistortedCameras()) {
    SCOPED_TRACE(name);
    int not_shown = 0;
    for (int y = 0; y < camera.height_px; y += 13) {
      for (int x = 0; x < camera.width_px; x += 13) {
        const std::optional<Vector2> n = NormalizedFromPixel(camera.lens, Vector2(x, y));
        if (n)
          ExpectNear(PixelFromNormalized(camera.lens, *n), Vector2(x, y), 1e-8);
        else
          ++not_shown;
      }
    }
    // In the corners of one lens.
    EXPECT_LT(not_shown, 20);
  }
}

TEST(CameraModel, TheAxisMeetsTheCentreWithoutRounding) {
  ExpectNear(PixelFromNormalized(BarrelTsaiLens(), Vector2::Zero()), {323.5, 236.25}, 0);
  ExpectNear(PixelFromNormalized(WideFisheyeLens(), Vector2::Zero()), {318, 243}, 0);
}

TEST(CameraModel, WithoutDistortionEveryLensIsAPinhole) {
  const Vector2 n(0.4, -0.3);
  const Vector2 pixel(320 + 500 * 0.4, 240 - 500 * 0.3);
  const TsaiLens tsai{.focal_mm = 5, .center_px = {320, 240}, .pitch_mm = {0.01, 0.01}};
  ExpectNear(PixelFromNormalized(tsai, n), pixel, 1e-9);
  ExpectNear(PixelFromNormalized(OpenCvLens{PinholeMatrix(500, 500, 320, 240), {}}, n), pixel,
             1e-9);
}

TEST(CameraModel, TsaiShowsNothingBeyondTheRadiusWhereItTurnsBack) {
  const TsaiLens lens = PincushionTsaiLens();
  // Xu = Xd (1 + κ1 Xd²) is largest at Xd = 1 / sqrt(-3 κ1), where it is two thirds of that.
  const double turning_mm = 1 / std::sqrt(3 * 0.006);
  const double farthest = 2 * turning_mm / 3 / lens.focal_mm;
  EXPECT_NEAR(FieldRadius(lens), farthest, 1e-12);
  EXPECT_TRUE(PixelFromNormalized(lens, {0, 0.9999 * farthest}).has_value());
  EXPECT_FALSE(PixelFromNormalized(lens, {0, 1.0001 * farthest}).has_value());
  const double turning_px = turning_mm / lens.pitch_mm.y();
  EXPECT_TRUE(NormalizedFromPixel(lens, lens.center_px + Vector2(0, 0.999 * turning_px)));
  EXPECT_FALSE(NormalizedFromPixel(lens, lens.center_px + Vector2(0, 1.001 * turning_px)));
}

TEST(CameraModel, TsaiStaysOnTheBranchThroughTheCentreUpToTheTurn) {
  const TsaiLens lens = PincushionTsaiLens();
  const double farthest = FieldRadius(lens);
  double last = 0;
  for (int i = 1; i <= 1000; ++i) {
    const std::optional<Vector2> pixel =
        PixelFromNormalized(lens, {farthest * (i - 0.5) / 1000, 0});
    ASSERT_TRUE(pixel.has_value());
    EXPECT_GT(pixel->x(), last);
    last = pixel->x();
  }
}

TEST(CameraModel, OpenCvLensShowsNothingBeyondTheRadiusWhereItTurnsBack) {
  // r (1 - r²) rises up to r² = 1/3.
  const OpenCvLens lens{PinholeMatrix(400, 400, 320, 240), {-1, 0, 0, 0, 0}};
  EXPECT_NEAR(FieldRadius(lens), std::sqrt(1.0 / 3), 1e-9);
  EXPECT_TRUE(PixelFromNormalized(lens, {0.57, 0}).has_value());
  EXPECT_FALSE(PixelFromNormalized(lens, {0.58, 0}).has_value());
  // Farther out the polynomial comes back to the same pixels: those directions are not seen.
  EXPECT_FALSE(PixelFromNormalized(lens, {0.9, 0}).has_value());
  // 400 · 2/3 · sqrt(1/3) = 153.96 pixels from the centre the picture ends.
  EXPECT_TRUE(NormalizedFromPixel(lens, {320 + 153, 240}).has_value());
  EXPECT_FALSE(NormalizedFromPixel(lens, {320 + 155, 240}).has_value());
}

TEST(CameraModel, AWiggleOfThePolynomialFarFromThePictureIsFound) {
  // The slope 1 - 3 s + 2 s² of f, with s = r², is negative between s = 0.5 and s = 1 only.
  const OpenCvLens lens{PinholeMatrix(400, 400, 320, 240), {-1, 0.4, 0, 0, 0}};
  EXPECT_NEAR(FieldRadius(lens), std::sqrt(0.5), 1e-9);
  EXPECT_FALSE(PixelFromNormalized(lens, {0, 1.5}).has_value());
}

TEST(CameraModel, ARationalLensShowsNothingBeyondWhereItTurnsBack) {
  // r / (1 + r²) rises up to r = 1.
  const OpenCvLens lens{PinholeMatrix(400, 400, 320, 240), {0, 0, 0, 0, 0, 1, 0, 0}};
  EXPECT_NEAR(FieldRadius(lens), 1, 1e-9);
  EXPECT_TRUE(PixelFromNormalized(lens, {0.99, 0}).has_value());
  EXPECT_FALSE(PixelFromNormalized(lens, {1.01, 0}).has_value());
  // 400 / 2 pixels from the centre the picture ends.
  EXPECT_TRUE(NormalizedFromPixel(lens, {320 + 199, 240}).has_value());
  EXPECT_FALSE(NormalizedFromPixel(lens, {320 + 201, 240}).has_value());
}

TEST(CameraModel, ARationalLensShowsNothingBeyondItsPole) {
  // r / (1 - r²) rises without end up to r = 1, and again beyond it.
  const OpenCvLens lens{PinholeMatrix(400, 400, 320, 240), {0, 0, 0, 0, 0, -1, 0, 0}};
  EXPECT_NEAR(FieldRadius(lens), 1, 1e-9);
  EXPECT_FALSE(PixelFromNormalized(lens, {1.2, 0}).has_value());
  ExpectNear(NormalizedFromPixel(lens, {320 + 400 * 0.5 / 0.75, 240}), {0.5, 0}, 1e-9);
}

TEST(CameraModel, ALensWhoseLastThreeCoefficientsVanishIsThatOfFive) {
  const OpenCvLens five = WideOpenCvLens();
  OpenCvLens eight = five;
  eight.distortion[5] = 1e-300;
  for (int i = 0; i < 200; ++i) {
    const Vector2 pixel(3.2 * i, 2.4 * (199 - i));
    const auto a = NormalizedFromPixel(five, pixel);
    if (!a) continue;
    ExpectNear(NormalizedFromPixel(eight, pixel), *a, 1e-12);
    ExpectNear(PixelFromNormalized(eight, *a), pixel, 1e-9);
  }
}

TEST(CameraModel, AFisheyeIsFollowedToWideAngles) {
  const FisheyeLens lens = WideFisheyeLens();
  for (const double angle_deg : {1.0, 45.0, 80.0, 84.0}) {
    const double r = std::tan(angle_deg * std::numbers::pi / 180);
    const Vector2 n(0.6 * r, 0.8 * r);
    const std::optional<Vector2> pixel = PixelFromNormalized(lens, n);
    ASSERT_TRUE(pixel.has_value());
    ExpectNear(NormalizedFromPixel(lens, *pixel), n, 1e-9 * (1 + r * r));
  }
}

TEST(CameraModel, ACameraWithoutAHeadDoesNotMove) {
  CameraCalibration camera;
  camera.X_CW = {ExpRotation({0.1, 0.2, 0.3}), {1, 2, 3}};
  const RigidTransform pose = camera.PoseAt({0.5, 0.5});
  EXPECT_EQ(pose.R, camera.X_CW.R);
  EXPECT_EQ(pose.p, camera.X_CW.p);
}

TEST(CameraModel, TheHeadTiltsFirstAndThenPans) {
  CameraCalibration camera;
  // Looks along world y from the origin: camera x is world x, camera y points down.
  camera.X_CW.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.head = PanTiltHead{.pan_axis_W = Vector3::UnitZ(), .tilt_axis_W = Vector3::UnitX()};
  const double quarter = std::numbers::pi / 2;
  // A quarter turn to the left: it looks along -x.
  EXPECT_NEAR(((camera.PoseAt({quarter, 0}) * Vector3(-5, 0, 0)) - Vector3(0, 0, 5)).norm(), 0,
              1e-12);
  // A quarter turn up: it looks along z, and what was above is now behind the top, along -y.
  EXPECT_NEAR(((camera.PoseAt({0, quarter}) * Vector3(0, 0, 5)) - Vector3(0, 0, 5)).norm(), 0,
              1e-12);
  EXPECT_NEAR(((camera.PoseAt({0, quarter}) * Vector3(0, -5, 0)) - Vector3(0, -5, 0)).norm(), 0,
              1e-12);
  // Both: tilted up it still looks along z, and its right side has panned from x to y.
  EXPECT_NEAR(((camera.PoseAt({quarter, quarter}) * Vector3(0, 3, 5)) - Vector3(3, 0, 5)).norm(), 0,
              1e-12);
}

TEST(CameraModel, AHeadsAxesNeedNotPassThroughTheLens) {
  CameraCalibration camera;
  camera.X_CW.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  // The lens is at the origin, 40 mm in front of the pan axis.
  camera.head = PanTiltHead{.pan_axis_W = Vector3::UnitZ(), .pan_point_W = {0, -40, 0}};
  const Vector3 lens_W = camera.PoseAt({std::numbers::pi / 2, 0}).Inverse().p;
  EXPECT_NEAR((lens_W - Vector3(-40, -40, 0)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace mocap
