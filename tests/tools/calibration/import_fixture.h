// Calibrations of other programs, for tests of reading them.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "core/errors.h"
#include "tests/support/temporary_folder.h"
#include "tools/calibration/exchange.h"

namespace mocap {

namespace fs = std::filesystem;

inline constexpr const char* kLens =
    "size = [1280, 720]\nmatrix = [[900.0, 0.0, 640.0], [0.0, 900.0, 360.0], [0.0, 0.0, 1.0]]\n";
inline constexpr const char* kFive = "distortions = [-0.1, 0.02, 0.0, 0.0, 0.0]\n";
inline constexpr const char* kPose = "rotation = [1.7, 0.2, 0.1]\ntranslation = [0.1, 1.0, 3.0]\n";
inline constexpr const char* kOtherPose =
    "rotation = [1.7, 1.2, 0.1]\ntranslation = [0.1, 1.0, 4.0]\n";
inline constexpr const char* kCameraInfo =
    "image_width: 1280\nimage_height: 720\ncamera_name: left\ncamera_matrix:\n  rows: 3\n  cols: "
    "3\n  data: [900.0, 0.0, 640.0, 0.0, 900.0, 360.0, 0.0, 0.0, 1.0]\ndistortion_model: "
    "plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.1, 0.02, 0.0, 0.0, "
    "0.0]\n";

inline std::string WhyRefused(const std::function<void()>& step) {
  try {
    step();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "accepted";
}

inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

class ImportTest : public ::testing::Test {
 protected:
  fs::path Write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_.path() / name).parent_path());
    testing::WriteText(folder_.path() / name, text);
    return folder_.path() / name;
  }
  std::string Why(const std::string& format, const fs::path& in, ImportOptions options = {}) {
    return WhyRefused([&] { ImportCameras(format, in, options); });
  }
  std::string WhyToml(const std::string& text) { return Why("pose2sim", Write("c.toml", text)); }
  // A pose2sim camera that is right, with one line changed.
  std::string WhyChanged(const std::string& from, const std::string& to) {
    return WhyToml(Replaced("[cam1]\n" + std::string(kLens) + kFive + kPose, from, to));
  }
  std::string OpenCv(const std::string& distortion, const std::string& pose = "") {
    return "%YAML:1.0\n---\nimage_width: 1280\nimage_height: 720\ncamera_matrix: "
           "!!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 900., 0., 640., 0., "
           "900., 360., 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: " +
           std::to_string(1 + std::count(distortion.begin(), distortion.end(), ',')) +
           "\n   cols: 1\n   dt: d\n   data: [ " + distortion + " ]\n" + pose;
  }

  testing::TemporaryFolder folder_;
};

inline constexpr const char* kOpenCvPose =
    "rotation: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ 1.7, 0.2, 0.1 "
    "]\ntranslation: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ 100., 1000., "
    "3000. ]\n";

}  // namespace mocap
