#include "core/reconstruction/camera/sensor_plane_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/errors.h"
#include "tests/core/reconstruction/lenses.h"

namespace mocap {
namespace {

TEST(SensorPlaneTable, StaysWithinHalfAPixelOfTheExactFormulaAnywhereInThePicture) {
  for (const auto& [name, camera] : DistortedCameras()) {
    SCOPED_TRACE(name);
    const SensorPlaneTable table(camera);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> x(-0.4, camera.width_px - 0.6);
    std::uniform_real_distribution<double> y(-0.4, camera.height_px - 0.6);
    int shown = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vector2 exact(x(random), y(random));
      const std::optional<Vector2> n = NormalizedFromPixel(camera.lens, exact);
      if (!n) continue;  // In the corners of one lens.
      ++shown;
      const SensorPlaneTable::Pixel pixel = table.Lookup(n->x(), n->y());
      // Half a pixel for the rounding, and next to nothing for the table.
      EXPECT_LT(std::abs(pixel.x - exact.x()), 0.53);
      EXPECT_LT(std::abs(pixel.y - exact.y()), 0.53);
    }
    EXPECT_GT(shown, 19000);
  }
}

TEST(SensorPlaneTable, LocatesBetweenPixelsToAFewHundredths) {
  for (const auto& [name, camera] : DistortedCameras()) {
    SCOPED_TRACE(name);
    const SensorPlaneTable table(camera);
    for (double y = 0; y < camera.height_px; y += 7.3) {
      for (double x = 0; x < camera.width_px; x += 7.3) {
        const std::optional<Vector2> n = NormalizedFromPixel(camera.lens, {x, y});
        if (!n) continue;
        SensorPlaneTable::Place place;
        ASSERT_TRUE(table.Locate(static_cast<float>(n->x()), static_cast<float>(n->y()), place));
        EXPECT_LT(std::hypot(place.x_px - x, place.y_px - y), 0.03);
      }
    }
  }
}

TEST(SensorPlaneTable, WhatThePictureDoesNotShowHasNoPixel) {
  for (const auto& [name, camera] : DistortedCameras()) {
    SCOPED_TRACE(name);
    const SensorPlaneTable table(camera);
    for (int i = 0; i < 360; ++i) {
      const Vector2 ray(std::cos(i * 0.0174533), std::sin(i * 0.0174533));
      for (double radius = 0; radius < 20; radius += radius < 2 ? 0.01 : 0.5) {
        const Vector2 n = radius * ray;
        const std::optional<Vector2> exact = PixelFromNormalized(camera.lens, n);
        // Of what lies on the picture's very edge nothing is asked.
        const bool clearly_outside = !exact || exact->x() < -0.6 || exact->y() < -0.6 ||
                                     exact->x() > 639.6 || exact->y() > 479.6;
        const SensorPlaneTable::Pixel pixel = table.Lookup(n.x(), n.y());
        if (clearly_outside) {
          EXPECT_LT(pixel.x, 0) << n.transpose();
          EXPECT_LT(pixel.y, 0) << n.transpose();
        }
      }
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_LT(table.Lookup(nan, 0).x, 0);
    EXPECT_LT(table.Lookup(0, std::numeric_limits<double>::infinity()).x, 0);
  }
}

TEST(SensorPlaneTable, DirectionsBeyondTheTurnOfALensAreNotFoldedBackIntoThePicture) {
  CameraCalibration camera;
  camera.width_px = 640;
  camera.height_px = 480;
  // Turns back 154 pixels from the centre, well within the picture.
  camera.lens = OpenCvLens{PinholeMatrix(400, 400, 320, 240), {-1, 0, 0, 0, 0}};
  const SensorPlaneTable table(camera);
  for (double r = 0; r < FieldRadius(camera.lens) - 1e-3; r += 0.01) {
    const Vector2 exact = *PixelFromNormalized(camera.lens, {r, 0});
    EXPECT_LT(std::abs(table.Lookup(r, 0).x - exact.x()), 0.55) << r;
  }
  for (const double r : {0.58, 0.7, 0.9, 1.0, 1.5}) EXPECT_LT(table.Lookup(r, 0).x, 0) << r;
}

TEST(SensorPlaneTable, ALensThatNoMemoryCouldHoldIsRefusedByName) {
  CameraCalibration camera;
  camera.name = "cam7";
  camera.width_px = 640;
  camera.height_px = 480;
  // Its picture is a sliver at the rim of 170 degrees.
  camera.lens = FisheyeLens{PinholeMatrix(1e6, 1e6, 1483600, 240), {}};
  std::string reason;
  try {
    const SensorPlaneTable table(camera);
  } catch (const SetupError& error) {
    reason = error.what();
  }
  EXPECT_NE(reason.find("camera cam7: the lens"), std::string::npos) << reason;
}

// The slope of a cell [px per cell], at places within it.
struct Slope {
  Eigen::Vector2f place, right, down;
};

Slope SlopeAt(const SensorPlaneTable::Nodes& t, float u, float v) {
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const auto node = [&](int x, int y) {
    const SensorPlaneTable::Place& p = t.nodes[(row + y) * t.columns + column + x];
    return Eigen::Vector2f(p.x_px, p.y_px);
  };
  const float a = u - static_cast<float>(column), b = v - static_cast<float>(row);
  const Eigen::Vector2f top = node(1, 0) - node(0, 0), bottom = node(1, 1) - node(0, 1);
  const Eigen::Vector2f left = node(0, 1) - node(0, 0), right = node(1, 1) - node(1, 0);
  return {node(0, 0) + a * top + b * (left + a * (right - left)), top + b * (bottom - top),
          left + a * (right - left)};
}

TEST(SensorPlaneTable, ItsBendsBoundHowFarAPlaceLiesFromWhereTheSlopeElsewhereLeads) {
  for (const auto& [name, camera] : DistortedCameras()) {
    SCOPED_TRACE(name);
    const SensorPlaneTable table(camera);
    const SensorPlaneTable::Nodes t = table.nodes();
    std::mt19937 random(2);
    std::uniform_real_distribution<float> u(3, t.last_column - 3.01f), v(3, t.last_row - 3.01f);
    constexpr float kReach = SensorPlaneTable::kBendReach_cells;
    std::uniform_real_distribution<float> step(-kReach, kReach);
    for (int i = 0; i < 20000; ++i) {
      const float at[2] = {u(random), v(random)};
      const float by[2] = {step(random), step(random)};
      const Slope here = SlopeAt(t, at[0], at[1]);
      const Slope there = SlopeAt(t, at[0] + by[0], at[1] + by[1]);
      const float bend = t.bends_px[static_cast<int>(at[1]) * t.columns + static_cast<int>(at[0])];
      const float du = std::abs(by[0]), dv = std::abs(by[1]);
      const Eigen::Vector2f led = here.place + by[0] * here.right + by[1] * here.down;
      EXPECT_LE((there.place - led).lpNorm<Eigen::Infinity>(),
                bend * (std::max(du, 2 * du - 1) + std::max(dv, 2 * dv - 1) + du * dv) + 1e-3f);
    }
  }
}

TEST(SensorPlaneTable, AWindowHoldsTheDirectionsOfItsPixelsAndLittleMore) {
  for (const auto& [name, camera] : DistortedCameras()) {
    SCOPED_TRACE(name);
    const SensorPlaneTable table(camera);
    const int left = 101, top = 52, right = 339, bottom = 402;
    const SensorPlaneTable::Window window = table.WindowOf(left, top, right, bottom);
    Vector2 low = Vector2::Constant(1e9), high = -low;
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const Vector2 n = *NormalizedFromPixel(camera.lens, Vector2(x, y));
        low = low.cwiseMin(n);
        high = high.cwiseMax(n);
      }
    }
    EXPECT_TRUE((window.low.array() <= low.array()).all());
    EXPECT_TRUE((window.high.array() >= high.array()).all());
    // Some ten pixels near the middle of the picture.
    const double pixel = (*NormalizedFromPixel(camera.lens, Vector2(321, 240)) -
                          *NormalizedFromPixel(camera.lens, Vector2(320, 240)))
                             .norm();
    EXPECT_LT((low - window.low).maxCoeff(), 60 * pixel);
    EXPECT_LT((window.high - high).maxCoeff(), 60 * pixel);
  }
}

TEST(SensorPlaneTable, TheInnerWindowHoldsNothingThatThePictureDoesNotShow) {
  for (const auto& [name, camera] : DistortedCameras()) {
    SCOPED_TRACE(name);
    const SensorPlaneTable table(camera);
    const SensorPlaneTable::Window inner = table.InnerWindow();
    for (int i = 0; i <= 50; ++i) {
      for (int j = 0; j <= 50; ++j) {
        // The window's own edge may lie on the picture's.
        const Vector2 share = Vector2::Constant(0.002) + 0.996 / 50 * Vector2(i, j);
        const Vector2 n = inner.low + share.cwiseProduct(inner.high - inner.low);
        if (!n.allFinite()) continue;  // The picture shows the lens's rim.
        EXPECT_GE(table.Lookup(n.x(), n.y()).x, 0);
      }
    }
  }
}

TEST(SensorPlaneTable, ALensThatShowsNothingInItsPictureIsRefused) {
  CameraCalibration camera;
  camera.name = "cam7";
  camera.width_px = 640;
  camera.height_px = 480;
  TsaiLens lens = PincushionTsaiLens();
  lens.kappa1 = -100;
  lens.center_px = {-5000, -5000};
  camera.lens = lens;
  EXPECT_THROW(SensorPlaneTable{camera}, SetupError);
}

}  // namespace
}  // namespace mocap
