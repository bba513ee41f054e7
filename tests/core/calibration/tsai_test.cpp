#include "core/calibration/tsai.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include "core/errors.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::Lt;

std::vector<PointDetection> ReadWillson(const std::filesystem::path& file) {
  std::vector<PointDetection> points;
  std::ifstream in(file);
  PointDetection p;
  while (in >> p.p_W.x() >> p.p_W.y() >> p.p_W.z() >> p.pixel.x() >> p.pixel.y())
    points.push_back(p);
  return points;
}

const std::filesystem::path kWillson = std::filesystem::path(MOCAP_SHARED_DIR) / "data" / "tsai";

TsaiSensor WillsonSensor() {
  TsaiSensor sensor;
  sensor.pitch_mm = {0.023, 0.023};
  sensor.center_px = {288, 192};  // The middle of his 576 x 384 sensor.
  return sensor;
}

/// A camera whose truth is known, and points that it sees.
struct Truth {
  TsaiLens lens{6.0, 0.004, 1.0, {325, 236}, {0.01, 0.0099}};
  RigidTransform X_CW{ExpRotation({0.5, -0.4, 0.3}), {-200, 150, 3000}};

  std::vector<PointDetection> See(const std::vector<Vector3>& points, double noise_px = 0) const {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 1);
    std::vector<PointDetection> seen;
    for (const Vector3& p_W : points) {
      const Vector3 p_C = X_CW * p_W;
      const auto pixel = PixelFromNormalized(lens, p_C.head<2>() / p_C.z());
      seen.push_back({p_W, *pixel + noise_px * Vector2(noise(random), noise(random))});
    }
    return seen;
  }
};

std::vector<Vector3> Grid(int layers) {
  std::vector<Vector3> points;
  for (int k = 0; k < layers; ++k)
    for (int j = -4; j <= 4; ++j)
      for (int i = -4; i <= 4; ++i) points.emplace_back(150 * i, 150 * j, 200 * k);
  return points;
}

TsaiSensor SensorOf(const Truth& truth) {
  TsaiSensor sensor;
  sensor.pitch_mm = truth.lens.pitch_mm;
  sensor.center_px = {319.5, 239.5};
  return sensor;
}

std::string ReasonOf(const std::vector<PointDetection>& points, const TsaiSensor& sensor) {
  try {
    CalibrateTsai(points, sensor);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TsaiTest, ReachesThePublishedErrorOnWillsonsCoplanarPoints) {
  const auto points = ReadWillson(kWillson / "cc_cd.dat");
  if (points.empty()) GTEST_SKIP() << "no points of Willson in " << kWillson;
  const TsaiCalibration c = CalibrateTsai(points, WillsonSensor());
  EXPECT_TRUE(c.coplanar);
  EXPECT_LE(c.mean_px, 0.0970);
  EXPECT_LE(c.worst_px, 0.290);
  const double published = 257.13342658 / 6283.2333043051;
  EXPECT_NEAR(c.lens.focal_mm / c.X_CW.p.z() / published, 1, 0.001);
}

TEST(TsaiTest, ReachesThePublishedErrorOnWillsonsNonCoplanarPoints) {
  const auto points = ReadWillson(kWillson / "ncc_cd.dat");
  if (points.empty()) GTEST_SKIP() << "no points of Willson in " << kWillson;
  const TsaiCalibration c = CalibrateTsai(points, WillsonSensor());
  EXPECT_FALSE(c.coplanar);
  EXPECT_LE(c.mean_px, 0.0800);
  EXPECT_LE(c.worst_px, 0.260);
  const double published = 69.974574039 / 1999.761873;
  EXPECT_NEAR(c.lens.focal_mm / c.X_CW.p.z() / published, 1, 0.001);
}

TEST(TsaiTest, FindsTheCameraThatMadeExactSpatialPoints) {
  Truth truth;
  truth.lens.sx = 1.01;
  const TsaiCalibration c = CalibrateTsai(truth.See(Grid(3)), SensorOf(truth));
  EXPECT_NEAR(c.lens.focal_mm, truth.lens.focal_mm, 1e-5);
  EXPECT_NEAR(c.lens.kappa1, truth.lens.kappa1, 1e-7);
  EXPECT_NEAR(c.lens.sx, 1.01, 1e-6);
  EXPECT_NEAR((c.lens.center_px - truth.lens.center_px).norm(), 0, 1e-3);
  EXPECT_NEAR((c.X_CW.p - truth.X_CW.p).norm(), 0, 1e-2);
  EXPECT_NEAR((c.X_CW.R - truth.X_CW.R).norm(), 0, 1e-6);
}

TEST(TsaiTest, FindsTheCameraThatMadeExactCoplanarPointsOnAnyPlane) {
  for (const Vector3& turn : {Vector3(0, 0, 0), Vector3(0.3, 0.5, 1), Vector3(-0.7, 0.1, 2.5)}) {
    Truth truth;
    std::vector<Vector3> plane = Grid(1);
    for (Vector3& p : plane) p = ExpRotation(turn) * p;
    const Vector3 normal_C = truth.X_CW.R * ExpRotation(turn) * Vector3::UnitZ();
    ASSERT_LT(std::abs(normal_C.z()), 0.96);
    const TsaiCalibration c = CalibrateTsai(truth.See(plane), SensorOf(truth));
    EXPECT_NEAR(c.lens.focal_mm, truth.lens.focal_mm, 1e-4) << turn.transpose();
    EXPECT_NEAR((c.X_CW.p - truth.X_CW.p).norm(), 0, 0.1) << turn.transpose();
    EXPECT_NEAR((c.X_CW.R - truth.X_CW.R).norm(), 0, 1e-4) << turn.transpose();
  }
}

TEST(TsaiTest, StaysWithinTheNoiseOfRandomCameras) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 20; ++i) {
    Truth truth;
    truth.X_CW.R = ExpRotation(Vector3(0.5 * u(random), 0.5 * u(random), 3 * u(random)));
    truth.X_CW.p = {100 * u(random), 100 * u(random), 2800 + 300 * u(random)};
    const TsaiCalibration c = CalibrateTsai(truth.See(Grid(3), 0.1), SensorOf(truth));
    EXPECT_THAT(c.rms_px, Lt(0.15)) << "camera " << i;
    EXPECT_NEAR((c.X_CW.Inverse().p - truth.X_CW.Inverse().p).norm(), 0, 10) << "camera " << i;
  }
}

TEST(TsaiTest, RefusesWhatDoesNotDetermineACamera) {
  const Truth truth;
  const TsaiSensor sensor = SensorOf(truth);
  std::vector<Vector3> few = Grid(1);
  few.resize(7);
  EXPECT_THAT(ReasonOf(truth.See(few), sensor), HasSubstr("at least 8"));
  std::vector<Vector3> line;
  for (int i = -6; i <= 6; ++i) line.emplace_back(50 * i, 80 * i, 20 * i);
  EXPECT_THAT(ReasonOf(truth.See(line), sensor), HasSubstr("one line"));
  std::vector<Vector3> few_in_space = {{0, 0, 0},     {300, 0, 0},     {0, 300, 0},
                                       {300, 300, 0}, {0, 0, 300},     {300, 0, 300},
                                       {0, 300, 300}, {300, 300, 300}, {150, 20, 80}};
  EXPECT_THAT(ReasonOf(truth.See(few_in_space), sensor), HasSubstr("at least 10"));
}

TEST(TsaiTest, RefusesAPlaneParallelToThePicture) {
  Truth truth;
  truth.X_CW.R = ExpRotation({0.004, 0, 0.7});
  EXPECT_THAT(ReasonOf(truth.See(Grid(1)), SensorOf(truth)), HasSubstr("parallel to the picture"));
}

TEST(TsaiTest, RefusesAMirroredWorld) {
  const Truth truth;
  std::vector<PointDetection> mirrored = truth.See(Grid(3));
  for (PointDetection& point : mirrored) point.p_W.x() = -point.p_W.x();
  EXPECT_THAT(ReasonOf(mirrored, SensorOf(truth)), HasSubstr("left-handed"));
}

}  // namespace
}  // namespace mocap
