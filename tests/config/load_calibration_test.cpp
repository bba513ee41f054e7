#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "config/load_config.h"
#include "core/errors.h"
#include "drivers/take/calibration_file.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Calibration : public ::testing::Test {
 protected:
  std::string ErrorOnLoading() const {
    try {
      LoadCalibration(file_);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  static std::vector<CameraCalibration> AllModels() {
    const testing::SmallTake take{.heads = true};
    std::vector<CameraCalibration> cameras = {
        testing::SmallCamera(take, 0), testing::SmallCamera({}, 1), testing::SmallCamera({}, 2)};
    cameras[0].head->pan_scale = 1.03;
    cameras[0].head->zero.tilt_rad = -0.25;
    OpenCvLens opencv;
    opencv.K << 490.756439, 0, 334.690674, 0, 493.26358, 222.39888, 0, 0, 1;
    opencv.distortion = {-0.368704915, 0.203186616, 1e-20, 1.78072587e-05, -0.1};
    cameras[1].lens = opencv;
    FisheyeLens fisheye;
    fisheye.K = opencv.K;
    fisheye.distortion = {0.1, -1.0 / 3, 5, 0};
    cameras[2].lens = fisheye;
    return cameras;
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "calibration.toml";
};

TEST_F(Calibration, ComesBackToTheLastBit) {
  const std::vector<CameraCalibration> cameras = AllModels();
  WriteCalibration(file_, cameras);
  const std::vector<CameraCalibration> loaded = LoadCalibration(file_);
  ASSERT_EQ(loaded.size(), cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    EXPECT_EQ(loaded[i].name, cameras[i].name);
    EXPECT_EQ(loaded[i].width_px, cameras[i].width_px);
    EXPECT_EQ(loaded[i].height_px, cameras[i].height_px);
    EXPECT_EQ(loaded[i].X_CW.R, cameras[i].X_CW.R);
    EXPECT_EQ(loaded[i].X_CW.p, cameras[i].X_CW.p);
    EXPECT_EQ(loaded[i].lens.index(), cameras[i].lens.index());
    EXPECT_EQ(loaded[i].head.has_value(), cameras[i].head.has_value());
  }
  const auto &tsai = std::get<TsaiLens>(cameras[0].lens),
             &tsai2 = std::get<TsaiLens>(loaded[0].lens);
  EXPECT_EQ(tsai2.focal_mm, tsai.focal_mm);
  EXPECT_EQ(tsai2.kappa1, tsai.kappa1);
  EXPECT_EQ(tsai2.sx, tsai.sx);
  EXPECT_EQ(tsai2.center_px, tsai.center_px);
  EXPECT_EQ(tsai2.pitch_mm, tsai.pitch_mm);
  EXPECT_EQ(std::get<OpenCvLens>(loaded[1].lens).K, std::get<OpenCvLens>(cameras[1].lens).K);
  EXPECT_EQ(std::get<OpenCvLens>(loaded[1].lens).distortion,
            std::get<OpenCvLens>(cameras[1].lens).distortion);
  EXPECT_EQ(std::get<FisheyeLens>(loaded[2].lens).distortion,
            std::get<FisheyeLens>(cameras[2].lens).distortion);
  EXPECT_EQ(loaded[0].head->tilt_point_W, cameras[0].head->tilt_point_W);
  EXPECT_EQ(loaded[0].head->pan_axis_W, cameras[0].head->pan_axis_W);
  EXPECT_EQ(loaded[0].head->pan_scale, 1.03);
  EXPECT_EQ(loaded[0].head->tilt_scale, 1);
  EXPECT_EQ(loaded[0].head->zero, (PanTiltAngles{0, -0.25}));
}

TEST_F(Calibration, ALensOfOpenCvHasFiveCoefficientsOrEight) {
  std::vector<CameraCalibration> cameras = AllModels();
  auto& lens = std::get<OpenCvLens>(cameras[1].lens);
  WriteCalibration(file_, cameras);
  EXPECT_EQ(std::get<OpenCvLens>(LoadCalibration(file_)[1].lens).distortion, lens.distortion);
  EXPECT_EQ(testing::ReadText(file_).find(", 0.0, 0.0, 0.0]\nrotation"), std::string::npos)
      << "eight are written where five say all";
  lens.distortion = {1.5, -0.8, 0.001, -0.0005, 0.2, 1.9, -0.6, 0.1};
  WriteCalibration(file_, cameras);
  EXPECT_EQ(std::get<OpenCvLens>(LoadCalibration(file_)[1].lens).distortion, lens.distortion);
}

TEST_F(Calibration, WhatCouldNotBeReadAgainIsNotWritten) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto why = [&](auto change) {
    std::vector<CameraCalibration> cameras = AllModels();
    change(cameras[1]);
    try {
      WriteCalibration(file_, cameras);
    } catch (const SetupError& error) {
      EXPECT_FALSE(std::filesystem::exists(file_));
      return std::string(error.what());
    }
    return std::string("written");
  };
  using Camera = CameraCalibration;
  EXPECT_THAT(why([&](Camera& c) { c.X_CW.p.x() = nan; }), HasSubstr("\"cam2\": its translation"));
  EXPECT_THAT(why([&](Camera& c) { c.X_CW.R *= 2; }), HasSubstr("its rotation"));
  EXPECT_THAT(why([&](Camera& c) { std::get<OpenCvLens>(c.lens).distortion[7] = nan; }),
              HasSubstr("its lens"));
  EXPECT_THAT(why([&](Camera& c) { c.width_px = 0; }), HasSubstr("its picture"));
  EXPECT_THAT(why([&](Camera& c) { c.name = "../x"; }), HasSubstr("letters, digits"));
  EXPECT_THAT(why([&](Camera& c) { c.name = "cam1"; }), HasSubstr("another camera has its name"));
}

TEST_F(Calibration, TellsItsAgeAndHealth) {
  CalibrationRecord record;
  record.made_s = 1'795'291'261;
  record.reprojection_px = 0.21;
  record.refined_s = 1'795'291'262;
  record.checked_s = 1'795'291'263;
  record.offsets = {{"cam2", 0.4, false}, {"cam1", 5.25, true}};
  WriteCalibration(file_, AllModels(), record);
  EXPECT_EQ(LoadCalibration(file_).size(), 3u);
  const CalibrationRecord loaded = LoadCalibrationRecord(file_);
  EXPECT_EQ(loaded.made_s, record.made_s);
  EXPECT_EQ(loaded.reprojection_px, 0.21);
  EXPECT_EQ(loaded.refined_s, record.refined_s);
  EXPECT_EQ(loaded.checked_s, record.checked_s);
  ASSERT_EQ(loaded.offsets.size(), 2u);
  EXPECT_EQ(loaded.offsets[1].camera, "cam1");
  EXPECT_EQ(loaded.offsets[1].px, 5.25);
  EXPECT_TRUE(loaded.offsets[1].has_moved);
  EXPECT_FALSE(loaded.offsets[0].has_moved);
}

TEST_F(Calibration, OneThatSaysNothingOfItselfIsOfUnknownAge) {
  WriteCalibration(file_, AllModels());
  EXPECT_EQ(LoadCalibrationRecord(file_).made_s, 0);
  EXPECT_EQ(LoadCalibrationRecord(file_).checked_s, 0);
}

TEST_F(Calibration, CamerasKeepTheOrderOfTheFile) {
  std::vector<CameraCalibration> cameras = AllModels();
  cameras[0].name = "zebra";
  cameras[1].name = "cam10";
  cameras[2].name = "cam2";
  WriteCalibration(file_, cameras);
  const std::vector<CameraCalibration> loaded = LoadCalibration(file_);
  ASSERT_EQ(loaded.size(), 3u);
  EXPECT_EQ(loaded[0].name, "zebra");
  EXPECT_EQ(loaded[1].name, "cam10");
  EXPECT_EQ(loaded[2].name, "cam2");
}

TEST_F(Calibration, RotationWithFewDigitsIsMadeOne) {
  WriteCalibration(file_, AllModels());
  std::string text = testing::ReadText(file_);
  const std::size_t begin = text.find("rotation = ");
  const std::size_t end = text.find('\n', begin);
  text.replace(begin, end - begin,
               "rotation = [[0.6825, -0.7308, -0.0093], [-0.2002, -0.1746, -0.9641], "
               "[0.7029, 0.6598, -0.2655]]");
  testing::WriteText(file_, text);
  const Matrix3 R = LoadCalibration(file_)[0].X_CW.R;
  EXPECT_NEAR((R * R.transpose() - Matrix3::Identity()).norm(), 0, 1e-14);
  EXPECT_NEAR(R(0, 0), 0.6825, 1e-3);
}

struct DamagedCalibration {
  const char* from;
  const char* to;
  const char* says;
};

TEST_F(Calibration, DamageIsNamedWithFileLineAndKey) {
  const DamagedCalibration cases[] = {
      {"[cameras.cam1]", "[cameras.cam1", "not TOML"},
      {"model = \"tsai\"", "model = \"pinhole9\"", "cam1.model is \"pinhole9\""},
      {"model = \"tsai\"", "model = 7", "cam1.model"},
      {"model = \"tsai\"\n", "", "cam1.model is missing"},
      {"size_px = [68, 50]", "size_px = [68]", "cam1.size_px"},
      {"size_px = [68, 50]", "size_px = [68, -50]", "cam1.size_px"},
      {"size_px = [68, 50]", "size_px = [68.5, 50]", "cam1.size_px"},
      {"size_px = [68, 50]", "size_px = [68, 1000000]", "cam1.size_px"},
      {"focal_mm = ", "focal_mm = -", "cam1.focal_mm is -5.4"},
      {"focal_mm = ", "focal_mm = 0 #", "cam1.focal_mm is 0"},
      {"focal_mm = ", "focal_mm = \"long\" #", "cam1.focal_mm"},
      {"focal_mm = ", "focal_mm = nan #", "cam1.focal_mm"},
      {"focal_mm = ", "focal_in = ", "cam1.focal_mm is missing"},
      {"kappa1 = ", "kappa2 = 0\nkappa1 = ", "cam1.kappa2 is unknown"},
      {"kappa1 = ", "kapa1 = ", "cam1.kappa1 is missing; expected a number; there is kapa1"},
      {"pitch_mm = [0.01", "pitch_mm = [0", "cam1.pitch_mm"},
      {"rotation = [[", "rotation = [[9", "cam1.rotation is not a rotation"},
      {"rotation = [[", "rotation = [[[1], ", "cam1.rotation"},
      {"rotation = ", "rotation = [[1,0,0],[0,1,0],[0,0,-1]] #", "cam1.rotation is a reflection"},
      {"rotation = ", "rotation = [[1,0,0],[0,1,0]] #", "cam1.rotation"},
      {"rotation = ", "rotation = [[1,0],[0,1],[0,0]] #", "cam1.rotation"},
      {"translation_mm = [0.0, ", "translation_mm = [", "cam1.translation_mm"},
      {"pan_axis = [0.0, 0.0, 1.0]", "pan_axis = [0.0, 0.0, 2.0]", "cam1.pan_tilt.pan_axis"},
      {"tilt_point_mm = ", "tilt_point = ", "cam1.pan_tilt.tilt_point_mm is missing"},
      {"[490.756439, 0.0, ", "[490.756439, 0.5, ", "cam2.matrix"},
      {"[490.756439, ", "[-490.756439, ", "cam2.matrix"},
      {"distortion = [", "distortion = [0.1, ", "cam2.distortion"},
      {"[cameras.cam2]", "[cameras.\"a b\"]", "cameras.a b"},
  };
  for (const DamagedCalibration& damaged : cases) {
    WriteCalibration(file_, AllModels());
    testing::ReplaceInFile(file_, damaged.from, damaged.to);
    EXPECT_THAT(ErrorOnLoading(), AllOf(HasSubstr(file_.string() + ":"), HasSubstr(damaged.says),
                                        Not(HasSubstr("\n"))))
        << damaged.to;
  }
}

TEST_F(Calibration, LineIsTheOneOfTheKey) {
  WriteCalibration(file_, AllModels());
  testing::ReplaceInFile(file_, "focal_mm = ", "focal_mm = -");
  EXPECT_THAT(ErrorOnLoading(), HasSubstr("calibration.toml:4: cameras.cam1.focal_mm"));
}

TEST_F(Calibration, WithoutCamerasOrFileIsRefused) {
  EXPECT_THAT(ErrorOnLoading(), HasSubstr("not found"));
  for (const char* text : {"", "[cameras]\n", "cameras = 3\n", "[camera.cam1]\n"}) {
    testing::WriteText(file_, text);
    EXPECT_THAT(ErrorOnLoading(), HasSubstr("camera")) << text;
  }
}

}  // namespace
}  // namespace mocap
