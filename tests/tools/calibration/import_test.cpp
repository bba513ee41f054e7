// Files of other programs that are wrong or incomplete.
#include "config/load_config.h"
#include "tests/tools/calibration/import_fixture.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST_F(ImportTest, WhatIsNoFiniteNumberIsRefusedByFileAndKey) {
  for (const char* bad : {"nan", "inf", "-inf", "\"3\"", "true", "[[1]]"}) {
    SCOPED_TRACE(bad);
    EXPECT_THAT(WhyChanged("[0.1, 1.0", std::string("[") + bad + ", 1.0"),
                AllOf(HasSubstr("c.toml:"), HasSubstr("cam1.translation")));
    EXPECT_THAT(WhyChanged("[[900.0", std::string("[[") + bad), HasSubstr("cam1.matrix"));
  }
  for (const char* bad : {".nan", ".Inf", "12x", "1e999", "'", "[1, [2]]", "{a: b}"}) {
    SCOPED_TRACE(bad);
    const fs::path file = Write("oc/cam1.yml", OpenCv(std::string("0.1, ") + bad + ", 0, 0, 0"));
    EXPECT_THAT(Why("opencv", file), HasSubstr("cam1.yml:"));
  }
}

TEST_F(ImportTest, ASizeThatIsNoneIsRefused) {
  for (const char* bad : {"[1e300, 720]", "[1280, -5.0]", "[0, 720]", "[1280.5, 720]", "[1280]",
                          "[1280, 720, 3]", "[9223372036854775807, 720]", "1280"})
    EXPECT_THAT(WhyChanged("[1280, 720]", bad), HasSubstr("cam1.size")) << bad;
}

TEST_F(ImportTest, AMatrixThatNoLensHasIsRefused) {
  const std::string good = "[[900.0, 0.0, 640.0], [0.0, 900.0, 360.0], [0.0, 0.0, 1.0]]";
  for (const char* bad : {"[[0.0, 0.0, 640.0], [0.0, 900.0, 360.0], [0.0, 0.0, 1.0]]",
                          "[[900.0, 0.0, 640.0], [0.0, -900.0, 360.0], [0.0, 0.0, 1.0]]",
                          "[[900.0, 2.0, 640.0], [0.0, 900.0, 360.0], [0.0, 0.0, 1.0]]",
                          "[[900.0, 0.0, 640.0], [0.0, 900.0, 360.0], [0.0, 0.0, 2.0]]",
                          "[[1e300, 0.0, 640.0], [0.0, 900.0, 360.0], [0.0, 0.0, 1.0]]",
                          "[[900.0, 0.0, 640.0], [0.0, 900.0, 360.0]]", "[]"})
    EXPECT_THAT(WhyChanged(good, bad), HasSubstr("cam1.matrix")) << bad;
}

TEST_F(ImportTest, ARotationThatIsNoneIsRefused) {
  for (const char* bad : {"[1.7, 0.2]", "[1.7, 0.2, 0.1, 0.3]", "[1e300, 0.0, 0.0]",
                          "[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]",
                          "[[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]"})
    EXPECT_THAT(WhyChanged("[1.7, 0.2, 0.1]", bad), HasSubstr("cam1.rotation")) << bad;
  EXPECT_THAT(WhyChanged("[1.7, 0.2, 0.1]", "[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]"),
              HasSubstr("reflection"));
  EXPECT_THAT(WhyChanged("rotation = [1.7, 0.2, 0.1]\n", ""), HasSubstr("no rotation"));
}

TEST_F(ImportTest, ACentreTooFarFromThePictureIsRefused) {
  EXPECT_THAT(WhyChanged("translation = [0.1,", "translation = [1e9,"), HasSubstr("--unit"));
}

TEST_F(ImportTest, TwoCamerasOfOneNameAreRefused) {
  const std::string camera = std::string("name = \"gopro\"\n") + kLens + kFive + kPose;
  EXPECT_THAT(WhyToml("[cam_01]\n" + camera + "[cam_02]\n" + camera),
              AllOf(HasSubstr("c.toml:"), HasSubstr("gopro")));
}

TEST_F(ImportTest, NamesThatLeadOutOfAFolderOrOutOfATextAreRefused) {
  for (const char* bad : {"../../escaped", "a b", "a\\\"b", "a.b", "", "a/b", "..", "a\\nb",
                          "\\u0000", "cam\\u00e9", "[x]"}) {
    SCOPED_TRACE(bad);
    EXPECT_THAT(WhyToml("[\"" + std::string(bad) + "\"]\n" + kLens + kFive + kPose),
                AllOf(HasSubstr("c.toml"), HasSubstr("letters, digits, _ and -")));
  }
  Write("oc/left cam.yml", OpenCv("0, 0, 0, 0", kOpenCvPose));
  EXPECT_THAT(Why("opencv", folder_.path() / "oc"), HasSubstr("left cam"));
}

TEST_F(ImportTest, NoWriterLetsANameLeadOut) {
  CameraCalibration camera = LoadCalibration(Write(
      "good.toml",
      "[cameras.cam1]\nmodel = \"opencv\"\nsize_px = [640, 480]\nmatrix = [[500.0, 0.0, 320.0], "
      "[0.0, 500.0, 240.0], [0.0, 0.0, 1.0]]\ndistortion = [0.0, 0.0, 0.0, 0.0, 0.0]\nrotation = "
      "[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]\ntranslation_mm = [0.0, 0.0, "
      "3000.0]\n"))[0];
  camera.name = "../escaped";
  for (const std::string& format : ExportFormats()) {
    const fs::path out = folder_.path() / "a" / ("out_" + format);
    EXPECT_THAT(WhyRefused([&] { ExportCameras(format, out, {camera}); }), HasSubstr("escaped"));
    EXPECT_FALSE(fs::exists(out)) << format;
  }
}

TEST_F(ImportTest, ACameraWithoutAPoseIsLeftOutAndTold) {
  const fs::path file =
      Write("c.toml", "[cameras.0]\n" + std::string(kLens) + kFive + kPose + "[cameras.1]\n" +
                          kLens + kFive + kOtherPose + "[cameras.2]\n" + kLens + kFive +
                          "[cameras.3]\nsize = [1280, 720]\n");
  const Imported imported = ImportCameras("pose2sim", file);
  EXPECT_THAT(imported.cameras, SizeIs(2));
  EXPECT_THAT(imported.notes, Contains(HasSubstr("no pose of 2")));
  EXPECT_THAT(imported.notes, Contains(HasSubstr("no lens of 3")));
}

TEST_F(ImportTest, LensesAloneAreNoCalibrationUnlessTheyAreAskedFor) {
  const fs::path file = Write("c.toml", "[cam1]\n" + std::string(kLens) + kFive);
  EXPECT_THAT(Why("pose2sim", file), AllOf(HasSubstr("no pose"), HasSubstr("--lenses")));
  const Imported imported = ImportCameras("pose2sim", file, {.lenses_alone = true});
  ASSERT_THAT(imported.cameras, SizeIs(1));
  EXPECT_EQ(imported.cameras[0].X_CW.p, Vector3::Zero());
}

TEST_F(ImportTest, TheSizeOfPicturesIsNotGuessed) {
  const std::string intri =
      "%YAML:1.0\n---\nnames: [ \"1\" ]\nK_1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n "
      "  data: [ 900., 0., 655.2, 0., 900., 352.9, 0., 0., 1. ]\ndist_1: !!opencv-matrix\n   "
      "rows: 1\n   cols: 5\n   dt: d\n   data: [ -0.1, 0.02, 0., 0., 0. ]\n";
  Write("em/intri.yml", intri);
  Write("em/extri.yml",
        "%YAML:1.0\n---\nnames: [ \"1\" ]\nR_1: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: "
        "d\n   data: [ 1.7, 0.2, 0.1 ]\nT_1: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n "
        "  data: [ 0.1, 1.0, 3.0 ]\n");
  EXPECT_THAT(Why("easymocap", folder_.path() / "em"),
              AllOf(HasSubstr("intri.yml"), HasSubstr("W_1"), HasSubstr("--size")));
  const Imported told =
      ImportCameras("easymocap", folder_.path() / "em", {.size_px = {{1280, 720}}});
  EXPECT_EQ(told.cameras[0].width_px, 1280);
  EXPECT_EQ(told.cameras[0].height_px, 720);
  Write("em/intri.yml", intri + "H_1: 700\nW_1: 1300\n");
  EXPECT_EQ(ImportCameras("easymocap", folder_.path() / "em").cameras[0].width_px, 1300);
}
}  // namespace
}  // namespace mocap
