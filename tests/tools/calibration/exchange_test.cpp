#include "tools/calibration/exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/errors.h"
#include "drivers/virtual_studio/room/camera_rig.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/calibration/lens_conversion.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::WriteText;

/// No two numbers alike, nothing symmetric: a swap or a mirror shows.
Cameras Asymmetric() {
  OpenCvLens opencv;
  opencv.K << 812.5, 0, 651.25, 0, 809.75, 349.5, 0, 0, 1;
  opencv.distortion = {-0.21, 0.06, 0.0011, -0.0007, 0.004};
  OpenCvLens other = opencv;
  other.K(0, 0) = 790.125;
  other.distortion = {0.09, -0.02, -0.0004, 0.0009, 0.001};
  return {
      {"cam_01", 1280, 720, opencv, {ExpRotation({0.3, -1.2, 0.7}), {120.5, 880.25, 3100.75}}, {}},
      {"cam_02", 1280, 720, other, {ExpRotation({-2.1, 0.4, 0.9}), {-640.5, 77.5, 2750.25}}, {}}};
}

Vector2 PixelOf(const CameraCalibration& camera, const Vector3& p_W) {
  const Vector3 p_C = camera.X_CW * p_W;
  return PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z()).value_or(Vector2(-1, -1));
}

/// Compares what cameras see, which is what counts.
void ExpectSameViews(const Cameras& a, const Cameras& b, double tolerance_px) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.size(); ++c) {
    EXPECT_EQ(a[c].name, b[c].name);
    for (int i = 0; i < 60; ++i) {
      const Vector3 p_C(-0.55 + 0.11 * (i % 11), -0.35 + 0.14 * (i / 11), 1);
      const Vector3 p_W = a[c].X_CW.Inverse() * (p_C * (1500 + 40 * i));
      EXPECT_NEAR((PixelOf(a[c], p_W) - PixelOf(b[c], p_W)).norm(), 0, tolerance_px)
          << a[c].name << " " << p_C.transpose();
    }
  }
}

TEST(ExchangeTest, Pose2SimComesBackTheSame) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "Calib.toml";
  ExportCameras("pose2sim", file, Asymmetric(), {.unit_mm = 1000});
  const Cameras back = ImportCameras("pose2sim", file, {.unit_mm = 1000}).cameras;
  ExpectSameViews(Asymmetric(), back, 1e-6);
  EXPECT_EQ(back[0].width_px, 1280);
  EXPECT_EQ(back[0].height_px, 720);
}

TEST(ExchangeTest, Pose2SimIsReadAsItsOwnDocumentationHasIt) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "Calib.toml";
  WriteText(file,
            "[cam_01]\nname = \"cam_01\"\nsize = [ 1088.0, 1920.0]\n"
            "matrix = [ [ 1681.2, 0.0, 540.5], [ 0.0, 1681.1, 961.9], [ 0.0, 0.0, 1.0]]\n"
            "distortions = [ -0.046, 0.139, 0.0006, -0.0004]\nrotation = [ 0.0, 0.0, "
            "1.5707963267948966]\n"
            "translation = [ -0.5, 1.25, 4.0]\nfisheye = false\n\n[metadata]\nadjusted = "
            "false\nerror = 0.0\n");
  const Cameras cameras = ImportCameras("pose2sim", file, {.unit_mm = 1000}).cameras;
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].X_CW.p, Vector3(-500, 1250, 4000));
  EXPECT_NEAR((cameras[0].X_CW.R * Vector3::UnitX() - Vector3::UnitY()).norm(), 0, 1e-12);
  EXPECT_EQ(std::get<OpenCvLens>(cameras[0].lens).distortion[4], 0);
}

TEST(ExchangeTest, AFisheyeOfPose2SimComesBackTheSame) {
  const TemporaryFolder folder;
  Cameras fisheyes = Asymmetric();
  for (CameraCalibration& camera : fisheyes)
    camera.lens = FisheyeLens{std::get<OpenCvLens>(camera.lens).K, {0.04, -0.011, 0.003, -0.0007}};
  ExportCameras("pose2sim", folder.path() / "Calib.toml", fisheyes, {.unit_mm = 1000});
  const Cameras back =
      ImportCameras("pose2sim", folder.path() / "Calib.toml", {.unit_mm = 1000}).cameras;
  EXPECT_TRUE(std::holds_alternative<FisheyeLens>(back[0].lens));
  ExpectSameViews(fisheyes, back, 1e-6);
}

TEST(ExchangeTest, AniposelibsUnitIsThatOfItsBoard) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "calibration.toml";
  ExportCameras("pose2sim", file, Asymmetric(), {.unit_mm = 25.4});
  ExpectSameViews(Asymmetric(), ImportCameras("pose2sim", file, {.unit_mm = 25.4}).cameras, 1e-6);
  WriteText(file,
            "[cam_0]\nname = \"A\"\nsize = [ 1280, 1024,]\nmatrix = [ [ 1400.0, 0.0, 639.5,], "
            "[ 0.0, 1400.0, 511.5,], [ 0.0, 0.0, 1.0,],]\ndistortions = [ -0.1, 0.0, 0.0, 0.0, "
            "0.0,]\nrotation = [ 0.0, 0.0, 0.0,]\ntranslation = [ 1.0, 2.0, 30.0,]\n\n"
            "[metadata]\nadjusted = false\nerror = 0.4\n");
  const Cameras cameras = ImportCameras("pose2sim", file, {.unit_mm = 10}).cameras;
  EXPECT_EQ(cameras[0].name, "A");
  EXPECT_EQ(cameras[0].X_CW.p, Vector3(10, 20, 300));
}

TEST(ExchangeTest, EasyMocapComesBackTheSame) {
  const TemporaryFolder folder;
  ExportCameras("easymocap", folder.path() / "easy", Asymmetric());
  ExpectSameViews(Asymmetric(), ImportCameras("easymocap", folder.path() / "easy").cameras, 1e-6);
}

TEST(ExchangeTest, OpenCvYamlComesBackTheSame) {
  const TemporaryFolder folder;
  ExportCameras("opencv", folder.path() / "cv", Asymmetric());
  ExpectSameViews(Asymmetric(), ImportCameras("opencv", folder.path() / "cv").cameras, 1e-6);
}

TEST(ExchangeTest, QualisysComesBackTheSame) {
  const TemporaryFolder folder;
  ExportCameras("qualisys", folder.path() / "a.qca.txt", Asymmetric());
  ExpectSameViews(Asymmetric(), ImportCameras("qualisys", folder.path() / "a.qca.txt").cameras,
                  1e-6);
}

TEST(ExchangeTest, ViconComesBackAsNearAsItsRadialModelAllows) {
  const TemporaryFolder folder;
  Cameras radial = Asymmetric();
  for (CameraCalibration& camera : radial) {
    OpenCvLens& lens = std::get<OpenCvLens>(camera.lens);
    lens.distortion[2] = lens.distortion[3] = 0;
  }
  ExportCameras("vicon", folder.path() / "a.xcp", radial);
  ExpectSameViews(radial, ImportCameras("vicon", folder.path() / "a.xcp").cameras, 0.3);
}

TEST(ExchangeTest, WillsonComesBackTheSameForTsaiLenses) {
  const TemporaryFolder folder;
  const Cameras rig = simulation::HangCameras({});
  ExportCameras("willson", folder.path() / "cal", rig);
  const Cameras back = ImportCameras("willson", folder.path() / "cal",
                                     {.size_px = {{rig[0].width_px, rig[0].height_px}}})
                           .cameras;
  ASSERT_EQ(back.size(), rig.size());
  for (std::size_t c = 0; c < rig.size(); ++c) {
    EXPECT_NEAR((back[c].X_CW.R - rig[c].X_CW.R).norm(), 0, 1e-12);
    EXPECT_EQ(back[c].X_CW.p, rig[c].X_CW.p);
    EXPECT_EQ(back[c].width_px, rig[c].width_px);
    EXPECT_EQ(back[c].height_px, rig[c].height_px);
    EXPECT_NEAR((PixelOf(back[c], {100, 50, 900}) - PixelOf(rig[c], {100, 50, 900})).norm(), 0,
                1e-6);
  }
}

TEST(ExchangeTest, TsaiLensesBecomeOpenCvLensesThatSeeTheSame) {
  for (CameraCalibration camera : simulation::HangCameras({})) {
    const Lens tsai = camera.lens;
    camera.lens = AsOpenCvLens(camera);
    for (double x = 0; x < camera.width_px; x += 53) {
      for (double y = 0; y < camera.height_px; y += 37) {
        const auto n = NormalizedFromPixel(tsai, {x, y});
        ASSERT_TRUE(n);
        EXPECT_NEAR((*PixelFromNormalized(camera.lens, *n) - Vector2(x, y)).norm(), 0, 0.3);
      }
    }
  }
}

TEST(ExchangeTest, NamesFileAndLineOfWhatIsMissing) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "bad.qca.txt";
  WriteText(file,
            "<calibration>\n<camera serial=\"1\">\n<transform x=\"1\" "
            "y=\"2\"/>\n</camera></calibration>");
  EXPECT_THAT(testing::SetupErrorOf([&] { ImportCameras("qualisys", file); }),
              HasSubstr("bad.qca.txt:3: calibration.camera.transform.z is missing"));
  WriteText(file, "[cam]\nmatrix = [[1");
  EXPECT_THAT(testing::SetupErrorOf([&] { ImportCameras("pose2sim", file, {.unit_mm = 1000}); }),
              HasSubstr("bad.qca.txt:2"));
  EXPECT_THAT(testing::SetupErrorOf([&] { ImportCameras("easymocap", folder.path()); }),
              HasSubstr("intri.yml"));
}

}  // namespace
}  // namespace mocap
