// What each format of other programs holds, and files that are damaged or hostile.
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>

#include "tests/tools/calibration/import_fixture.h"
#include "tools/calibration/studio_check.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST_F(ImportTest, AllEightCoefficientsOfOpenCvAreKept) {
  const fs::path file =
      Write("oc/cam1.yml", OpenCv("1.5, -0.8, 0.001, -0.0005, 0.2, 1.9, -0.6, 0.1", kOpenCvPose));
  const Cameras cameras = ImportCameras("opencv", folder_.path() / "oc").cameras;
  EXPECT_THAT(std::get<OpenCvLens>(cameras[0].lens).distortion,
              ElementsAre(1.5, -0.8, 0.001, -0.0005, 0.2, 1.9, -0.6, 0.1));
  for (const char* format : {"mocap", "pose2sim", "easymocap", "opencv"}) {
    SCOPED_TRACE(format);
    ExportCameras(format, folder_.path() / format, cameras);
    const Cameras back = ImportCameras(format, folder_.path() / format).cameras;
    EXPECT_EQ(std::get<OpenCvLens>(back[0].lens).distortion,
              std::get<OpenCvLens>(cameras[0].lens).distortion);
  }
  for (const char* format : {"qualisys", "vicon"})
    EXPECT_THAT(WhyRefused([&] { ExportCameras(format, folder_.path() / format, cameras); }),
                AllOf(HasSubstr("cam1"), HasSubstr(format), HasSubstr("eight")));
}

TEST_F(ImportTest, WhatIsMoreThanEightCoefficientsIsRefusedUnlessItIsZero) {
  const std::string eight = "0.1, 0.2, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0";
  const auto why = [&](const std::string& rest) {
    return Why("opencv", Write("cam1.yml", OpenCv(eight + rest, kOpenCvPose)));
  };
  EXPECT_EQ(why(", 0., 0., 0., 0."), "accepted");
  EXPECT_EQ(why(", 0., 0., 0., 0., 0., 0."), "accepted");
  EXPECT_THAT(why(", 0., 0.001, 0., 0."), AllOf(HasSubstr("cam1.yml"), HasSubstr("thin prism")));
  EXPECT_THAT(why(", 0., 0., 0., 0., 0.01, 0."), HasSubstr("tilted sensor"));
  EXPECT_THAT(why(", 0."), HasSubstr("9 numbers"));
  EXPECT_THAT(Why("opencv", Write("cam1.yml", OpenCv("0.1, 0.2", kOpenCvPose))),
              HasSubstr("2 numbers"));
  EXPECT_THAT(
      Why("opencv", Write("cam1.yml", OpenCv("0, 0, 0, 0, 0",
                                             std::string("fisheye_model: 1\n") + kOpenCvPose))),
      HasSubstr("a fisheye has 4"));
}

TEST_F(ImportTest, ALensThatFoldsInsideThePictureIsTold) {
  const fs::path file = Write("c.toml", Replaced("[cam1]\n" + std::string(kLens) + kFive + kPose,
                                                 "-0.1, 0.02", "-1.0, 0.0"));
  for (const bool lenses_alone : {false, true})
    EXPECT_THAT(ImportCameras("pose2sim", file, {.lenses_alone = lenses_alone}).notes,
                Contains(AllOf(HasSubstr("cam1"), HasSubstr("folds"))));
}

TEST_F(ImportTest, AFisheyeThatSeesBesideItselfDoesNotFold) {
  const std::string wide =
      "[cam1]\nfisheye = true\nsize = [1280, 720]\nmatrix = [[320.0, 0.0, 640.0], [0.0, 320.0, "
      "360.0], [0.0, 0.0, 1.0]]\ndistortions = [0.0, 0.0, 0.0, 0.0]\n";
  EXPECT_THAT(ImportCameras("pose2sim", Write("c.toml", wide + kPose)).notes, IsEmpty());
}

TEST_F(ImportTest, ACheckTellsOfLensesThatFoldAndOfLensesWithoutAPose) {
  Cameras cameras =
      ImportCameras("pose2sim", Write("c.toml", "[cam1]\n" + std::string(kLens) + kFive),
                    {.lenses_alone = true})
          .cameras;
  EXPECT_THAT(CheckCameras(cameras, true).at(0).text, HasSubstr("intrinsics without a pose"));
  cameras[0].X_CW.p = {0, 1000, 3000};
  cameras[0].X_CW.R = ExpRotation({1.8, 0, 0});
  EXPECT_THAT(CheckCameras(cameras, true), IsEmpty());
  std::get<OpenCvLens>(cameras[0].lens).distortion[0] = -1;
  EXPECT_THAT(CheckCameras(cameras, true).at(0).text, HasSubstr("folds"));
}

TEST_F(ImportTest, AStudioInMetresIsToldByItsSize) {
  const fs::path file = Write("c.toml", "[cam1]\n" + std::string(kLens) + kFive + kPose +
                                            "[cam2]\n" + kLens + kFive + kOtherPose);
  EXPECT_THAT(ImportCameras("pose2sim", file, {.unit_mm = 1}).notes, Contains(HasSubstr("metres")));
  EXPECT_THAT(ImportCameras("pose2sim", file).notes, IsEmpty());
}

TEST_F(ImportTest, RosCameraInfoIsALensWithoutAPoseAndThatIsTold) {
  Write("ros/cam1.yml", kCameraInfo);
  for (const char* format : {"opencv", "ros"}) {
    const Imported imported = ImportCameras(format, folder_.path() / "ros");
    ASSERT_THAT(imported.cameras, SizeIs(1));
    EXPECT_TRUE(imported.are_lenses_alone);
    EXPECT_EQ(imported.cameras[0].name, "cam1");
    EXPECT_EQ(std::get<OpenCvLens>(imported.cameras[0].lens).distortion[0], -0.1);
    EXPECT_THAT(imported.notes, ElementsAre(AllOf(HasSubstr("cam1"), HasSubstr("without a pose"))));
  }
  Write("ros/cam1.yml", Replaced(kCameraInfo, "plumb_bob", "equidistant"));
  EXPECT_THAT(Why("ros", folder_.path() / "ros"), HasSubstr("a fisheye has 4"));
  Write("ros/cam1.yml", Replaced(kCameraInfo, "plumb_bob", "mei"));
  EXPECT_THAT(Why("ros", folder_.path() / "ros"), AllOf(HasSubstr("cam1.yml:"), HasSubstr("mei")));
}

TEST_F(ImportTest, AFolderOfOpenCvsLensesWithOnePoseHasOneCamera) {
  Write("oc/cam1.yml", OpenCv("0, 0, 0, 0", kOpenCvPose));
  Write("oc/cam2.yml", OpenCv("0, 0, 0, 0"));
  const Imported imported = ImportCameras("opencv", folder_.path() / "oc");
  EXPECT_THAT(imported.cameras, SizeIs(1));
  EXPECT_THAT(imported.notes, Contains(HasSubstr("no pose of cam2")));
}

TEST_F(ImportTest, KalibrsChainIsFollowedInMetres) {
  const std::string lens =
      "  camera_model: pinhole\n  intrinsics: [900.0, 901.0, 640.0, 360.0]\n  distortion_model: "
      "radtan\n  distortion_coeffs: [-0.1, 0.02, 0.001, -0.002]\n  resolution: [1280, 720]\n";
  // Each camera stands 0.5 m to the right of the one before and is turned by 90 degrees about z.
  const std::string link =
      "  T_cn_cnm1:\n  - [0.0, 1.0, 0.0, 0.0]\n  - [-1.0, 0.0, 0.0, 0.5]\n  - [0.0, 0.0, 1.0, "
      "0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n";
  const std::string chain = "cam0:\n" + lens + "cam1:\n" + link + lens + "cam2:\n" + link + lens;
  const Cameras cameras = ImportCameras("kalibr", Write("chain.yaml", chain)).cameras;
  ASSERT_THAT(cameras, SizeIs(3));
  EXPECT_EQ(cameras[0].X_CW.p, Vector3::Zero());
  EXPECT_NEAR((cameras[1].X_CW * Vector3(1, 0, 0) - Vector3(0, 499, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((cameras[2].X_CW * Vector3(1, 0, 0) - Vector3(499, 500, 0)).norm(), 0, 1e-9);
  EXPECT_EQ(std::get<OpenCvLens>(cameras[2].lens).distortion[3], -0.002);
  const auto why = [&](const std::string& from, const std::string& to) {
    return Why("kalibr", Write("chain.yaml", Replaced(chain, from, to)));
  };
  EXPECT_THAT(why("pinhole", "omni"), AllOf(HasSubstr("cam0.camera_model"), HasSubstr("omni")));
  EXPECT_THAT(why("radtan", "fov"), HasSubstr("cam0.distortion_model"));
  EXPECT_THAT(why("0.001, -0.002]", "0.001]"),
              HasSubstr("cam0.distortion_coeffs has 3 numbers; expected 4"));
  EXPECT_THAT(why("901.0, ", ""), HasSubstr("cam0.intrinsics has 3 numbers; expected 4"));
  EXPECT_THAT(why("[0.0, 0.0, 1.0, 0.0]", "[0.0, 0.0, 2.0, 0.0]"), HasSubstr("cam1.T_cn_cnm1"));
  EXPECT_THAT(why("cam1:", "camX:"), HasSubstr("no pose"));
  Write("chain.yaml", Replaced(Replaced(chain, "radtan", "equidistant"), "radtan", "none"));
  const Cameras others = ImportCameras("kalibr", folder_.path() / "chain.yaml").cameras;
  EXPECT_EQ(std::get<FisheyeLens>(others[0].lens).distortion[0], -0.1);
  EXPECT_EQ(std::get<OpenCvLens>(others[1].lens).distortion[0], 0);
}

TEST_F(ImportTest, HiddenFilesArePassedOver) {
  Write("oc/cam1.yml", OpenCv("0, 0, 0, 0", kOpenCvPose));
  Write("oc/._cam1.yml", std::string("\0\5\26\7Mac OS X", 12));
  Write("oc/.DS_Store", "x");
  EXPECT_THAT(ImportCameras("opencv", folder_.path() / "oc").cameras, SizeIs(1));
  Write("cal/._cam1.cal", "x");
  EXPECT_THAT(Why("willson", folder_.path() / "cal"), HasSubstr("contains no file NAME.cal"));
}

TEST_F(ImportTest, OpenCvsXmlWindowsLinesAndByteOrderMarksAreRead) {
  const std::string xml =
      "<?xml version=\"1.0\"?>\n<opencv_storage>\n<!-- a comment -->\n"
      "<image_width>1280</image_width>\n<image_height>720</image_height>\n<camera_matrix "
      "type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n  <data>\n  "
      "  900. 0. 640. 0. 900. 360. 0. 0. 1.</data></camera_matrix>\n<distortion_coefficients "
      "type_id=\"opencv-matrix\"><rows>5</rows><cols>1</cols><dt>d</dt><data>-1e-01 0.02 0 0 "
      "0</data></distortion_coefficients>\n<rotation><rows>3</rows><cols>1</cols><data>1.7 0.2 "
      "0.1</data></rotation><translation><rows>3</rows><cols>1</cols><data>1 2 "
      "3000</data></translation>\n</opencv_storage>\n";
  const Cameras of_xml = ImportCameras("opencv", Write("cam1.xml", xml)).cameras;
  EXPECT_EQ(std::get<OpenCvLens>(of_xml[0].lens).distortion[0], -0.1);
  EXPECT_EQ(of_xml[0].X_CW.p, Vector3(1, 2, 3000));
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : OpenCv("-0.1, 0.02, 0, 0, 0", kOpenCvPose))
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const Cameras of_yaml = ImportCameras("opencv", Write("cam1.yml", windows)).cameras;
  EXPECT_EQ(std::get<OpenCvLens>(of_yaml[0].lens).distortion[0], -0.1);
}

TEST_F(ImportTest, OpenCvReadsWhatIsWrittenForIt) {
  const Cameras cameras =
      ImportCameras(
          "opencv",
          Write("cam1.yml", OpenCv("1.5, -0.8, 0.001, -0.0005, 0.2, 1.9, -0.6, 0.1", kOpenCvPose)))
          .cameras;
  ExportCameras("opencv", folder_.path() / "cv", cameras);
  ExportCameras("easymocap", folder_.path() / "em", cameras);
  cv::Mat distortion, K, T;
  cv::FileStorage(folder_.path() / "cv/cam1.yml",
                  cv::FileStorage::READ)["distortion_coefficients"] >>
      distortion;
  ASSERT_EQ(distortion.total(), 8u);
  EXPECT_EQ(distortion.at<double>(7), 0.1);
  cv::FileStorage(folder_.path() / "em/intri.yml", cv::FileStorage::READ)["K_cam1"] >> K;
  EXPECT_EQ(K.at<double>(0, 2), 640);
  cv::FileStorage(folder_.path() / "em/extri.yml", cv::FileStorage::READ)["T_cam1"] >> T;
  EXPECT_EQ(T.at<double>(2), 3);
}

TEST_F(ImportTest, HostileYamlIsOneLine) {
  const auto why = [&](const std::string& text) {
    const std::string reason = Why("opencv", Write("cam1.yml", text));
    EXPECT_THAT(reason, HasSubstr("cam1.yml"));
    EXPECT_EQ(reason.find('\n'), std::string::npos);
    return reason;
  };
  EXPECT_THAT(why(std::string(300'000, '[')), HasSubstr("nested"));
  EXPECT_THAT(why("a: " + std::string(300'000, '{')), HasSubstr("a key that is not text"));
  std::string deep;
  for (int i = 0; i < 3000; ++i) deep += std::string(i, ' ') + "a:\n";
  EXPECT_THAT(why(deep), HasSubstr("nested"));
  std::string laughs = "a0: &a0 [1, 2, 3, 4, 5, 6, 7, 8, 9]\n";
  for (int i = 1; i < 12; ++i) {
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 9; ++k) laughs += "*a" + std::to_string(i - 1) + ", ";
    laughs += "]\n";
  }
  EXPECT_THAT(why(laughs), HasSubstr("too large for a calibration"));
  std::string many;
  for (int i = 0; i < 300'000; ++i) many += "k" + std::to_string(i) + ": 1\n";
  EXPECT_THAT(why(many), HasSubstr("too large for a calibration"));
  EXPECT_THAT(why(""), HasSubstr("empty"));
  EXPECT_THAT(why("just words"), HasSubstr("no keys"));
  EXPECT_THAT(why("a: 1\na: 2\n"), HasSubstr("twice"));
  EXPECT_THAT(why("a: *b\n"), HasSubstr("*b"));
  EXPECT_THAT(why("a: &b [*b]\n"), HasSubstr("*b"));
  EXPECT_THAT(why(std::string(1000, 'k') + ": 1\n"), HasSubstr("too large for a calibration"));
  EXPECT_THAT(why("a: [1, 2"), HasSubstr("not YAML"));
  EXPECT_THAT(why(std::string("\0\1\2", 3)), HasSubstr("not YAML"));
  EXPECT_THAT(why("<?xml version=\"1.0\"?><opencv_storage>"), HasSubstr("cam1.yml"));
}

TEST_F(ImportTest, AFileThatIsCutOffAnywhereHasNoPose) {
  const std::string whole = OpenCv("-0.1, 0.02, 0, 0, 0", kOpenCvPose);
  int refused = 0;
  for (std::size_t length = 0; length + 3 < whole.size(); length += 7) {
    try {
      const Imported cut = ImportCameras("opencv", Write("cam1.yml", whole.substr(0, length)));
      EXPECT_TRUE(cut.are_lenses_alone) << length;
      EXPECT_EQ(std::get<OpenCvLens>(cut.cameras.at(0).lens).distortion[1], 0.02) << length;
    } catch (const SetupError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

TEST_F(ImportTest, HostileXmlIsOneLine) {
  const auto repeated = [](int times, const std::string& text) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  const auto why = [&](const std::string& text) {
    const std::string reason = Why("opencv", Write("cam1.xml", text));
    EXPECT_THAT(reason, HasSubstr("cam1.xml"));
    EXPECT_EQ(reason.find('\n'), std::string::npos);
    return reason;
  };
  const std::string open = repeated(300'000, "<a>"), closed = repeated(300'000, "</a>");
  EXPECT_THAT(why("<opencv_storage>" + open + closed + "</opencv_storage>"), HasSubstr("nested"));
  EXPECT_THAT(why("<opencv_storage>" + open), HasSubstr("not XML"));
  EXPECT_THAT(why("<opencv_storage>" + repeated(2'000'000, "<a/>") + "</opencv_storage>"),
              HasSubstr("too large for a calibration"));
  EXPECT_THAT(why("<opencv_storage>" + repeated(300'000, "<a/>") + "</opencv_storage>"),
              HasSubstr("too large for a calibration"));
  EXPECT_THAT(why("<opencv_storage><a>" + repeated(3'000'000, "1 ") + "</a></opencv_storage>"),
              HasSubstr("too large for a calibration"));
  EXPECT_THAT(why(std::string(300'000, '<')), HasSubstr("not XML"));
  EXPECT_THAT(why(std::string(300'000, '<') + ">"), HasSubstr("not XML"));
  EXPECT_THAT(why("<a>1</a>"), HasSubstr("not XML of OpenCV"));
  // Entities are not expanded: neither to more text, nor to another file's.
  const std::string entity =
      "<!DOCTYPE a [<!ENTITY e SYSTEM \"" + (folder_.path() / "cam1.xml").string() + "\">]>";
  EXPECT_THAT(why(entity + "<opencv_storage><camera_matrix>&e;</camera_matrix></opencv_storage>"),
              HasSubstr("camera_matrix is \"&e;\""));
  EXPECT_THAT(why("<opencv_storage>\n<image_width>1</image_width><image_width>2</image_width>"
                  "</opencv_storage>"),
              HasSubstr("cam1.xml:2: opencv_storage.image_width appears twice"));
  EXPECT_THAT(Why("qualisys", Write("a.qca.txt", "")), HasSubstr("not XML"));
  EXPECT_THAT(Why("qualisys", Write("a.qca.txt", "<calibration>\n<camera serial=\"1\">")),
              HasSubstr("a.qca.txt:2: is not XML"));
}

TEST_F(ImportTest, WhatIsNoReadableFileIsSaidAsItIs) {
  for (const char* format : {"pose2sim", "kalibr", "qualisys", "vicon"})
    EXPECT_THAT(Why(format, folder_.path() / "absent"), HasSubstr("absent")) << format;
  for (const char* format : {"kalibr", "qualisys", "vicon"})
    EXPECT_THAT(Why(format, folder_.path()), HasSubstr("is a folder")) << format;
  for (const char* format : {"opencv", "willson"})
    EXPECT_THAT(Why(format, folder_.path()), HasSubstr("contains no file")) << format;
}

TEST_F(ImportTest, WillsonsNumbersAreReadToTheLast) {
  const std::string numbers =
      "640 640 0.01 0.01 0.01 0.01 320 240 1 6 0.004 10 20 3000 0.1 0.2 0.3";
  const ImportOptions size{.size_px = {{640, 480}}};
  EXPECT_EQ(Why("willson", Write("cam1.cal", numbers + " 0 0"), size), "accepted");
  EXPECT_THAT(Why("willson", Write("cam1.cal", numbers)), HasSubstr("--size"));
  EXPECT_THAT(Why("willson", Write("cam1.cal", numbers + " oops"), size), HasSubstr("oops"));
  EXPECT_THAT(Why("willson", Write("cam1.cal", numbers + " 0.1 0"), size), HasSubstr("p1"));
  EXPECT_THAT(Why("willson", Write("cam1.cal", Replaced(numbers, " 6 ", " 0 ")), size),
              HasSubstr("above 0"));
  EXPECT_THAT(Why("willson", Write("cam1.cal", Replaced(numbers, " 6 ", " 1e300 ")), size),
              HasSubstr("focal length"));
  EXPECT_THAT(Why("willson", Write("cam1.cal", numbers), {.size_px = {{800, 480}}}),
              HasSubstr("640"));
}

TEST_F(ImportTest, AFormatThatCannotHoldALensIsRefusedBeforeAnythingIsWritten) {
  const Cameras cameras =
      ImportCameras("opencv", Write("cam1.yml", OpenCv("-0.1, 0.02, 0.02, -0.02, 0", kOpenCvPose)))
          .cameras;
  const fs::path out = folder_.path() / "a.xcp";
  EXPECT_THAT(WhyRefused([&] { ExportCameras("vicon", out, cameras); }),
              AllOf(StartsWith("--to vicon"), HasSubstr("cam1")));
  EXPECT_FALSE(fs::exists(out));
}
}  // namespace
}  // namespace mocap
