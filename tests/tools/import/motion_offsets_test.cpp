// Offsets by silhouettes of somebody who moves.
#include "tools/import/motion_offsets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace mocap {
namespace {

constexpr double kPi = std::numbers::pi;

/// Outermost points of a person who walks about, waves and bends.
std::vector<Vector3> BodyAt(double time_s) {
  const double t = time_s;
  const Vector3 hips(900 * std::sin(0.7 * t), 700 * std::sin(1.1 * t + 1), 900);
  const double bend = 0.3 * std::sin(2.3 * t), step = 350 * std::sin(2 * kPi * 0.9 * t);
  std::vector<Vector3> points = {hips + Vector3(600 * bend, 0, 800 * std::cos(bend)),
                                 hips + Vector3(0, 120, 650), hips + Vector3(0, -120, 650)};
  points.push_back(hips + Vector3(400 * std::cos(3.1 * t), 300, 500 + 300 * std::sin(3.1 * t)));
  points.push_back(hips + Vector3(-200, -500 + 100 * std::sin(4 * t), 400));
  points.push_back(hips + Vector3(step, 100, -900));
  points.push_back(hips + Vector3(-step, -100, -900));
  return points;
}

struct Filmed {
  double begin_s = 0, rate_hz = 30, length_s = 6, error_px = 0.5;
};

/// What a camera on the wall sees, on its own clock, which begins with 0.
CameraHulls Film(double direction, const Filmed& filmed) {
  CameraHulls camera;
  camera.lens_W = {4000 * std::cos(direction), 3500 * std::sin(direction), 2200};
  camera.pixel_rad = 1.0 / 500;
  camera.height_px = 480;
  std::mt19937 random(static_cast<unsigned>(1000 * direction));
  std::normal_distribution<double> error(0, filmed.error_px * camera.pixel_rad);
  for (int i = 0; i < filmed.length_s * filmed.rate_hz; ++i) {
    SeenHull& hull = camera.frames.emplace_back();
    hull.time_s = i / filmed.rate_hz;
    for (const Vector3& point : BodyAt(filmed.begin_s + hull.time_s)) {
      const Vector3 ray = (point - camera.lens_W).normalized();
      const Vector3 wrong(error(random), error(random), error(random));
      hull.corners.push_back({(ray + wrong).normalized(), false});
    }
  }
  return camera;
}

std::vector<CameraHulls> FilmAll(const std::vector<Filmed>& filmed) {
  std::vector<CameraHulls> cameras;
  for (std::size_t i = 0; i < filmed.size(); ++i)
    cameras.push_back(Film(
        0.3 + 2 * kPi * static_cast<double>(i) / static_cast<double>(filmed.size()) + 0.2 * (i % 2),
        filmed[i]));
  return cameras;
}

void ExpectBegins(const std::vector<Filmed>& filmed, const std::vector<ClockFit>& clocks,
                  double within_s) {
  for (std::size_t i = 0; i < filmed.size(); ++i) {
    EXPECT_TRUE(clocks[i].is_known) << i;
    EXPECT_NEAR(clocks[i].offset_s - clocks[0].offset_s, filmed[i].begin_s - filmed[0].begin_s,
                within_s)
        << i;
    EXPECT_GT(clocks[i].clearness, 1.2) << i;
  }
}

std::vector<ClockFit> Clocks(const std::vector<Filmed>& filmed) {
  return ClocksByMotion(FilmAll(filmed), std::vector<ClockFit>(filmed.size()), [] {});
}

TEST(ClocksByMotion, AreFoundBetweenFrames) {
  const std::vector<Filmed> filmed = {{1}, {1.512}, {0.207}, {0.7351}, {1.0166}};
  ExpectBegins(filmed, Clocks(filmed), 0.002);
}

TEST(ClocksByMotion, AreFoundForDifferentRates) {
  const std::vector<Filmed> filmed = {{1}, {1.4, 25}, {0.2, 29.97}, {0.7, 60}};
  ExpectBegins(filmed, Clocks(filmed), 0.003);
}

TEST(ClocksByMotion, DoNotPreferHalfAFrame) {
  // Frames at the same moments: the mean of two frames, with less noise, is no better.
  const std::vector<Filmed> filmed = {{1, 30, 6, 1.5}, {1, 30, 6, 1.5}, {1, 30, 6, 1.5}};
  ExpectBegins(filmed, Clocks(filmed), 0.003);
}

TEST(ClocksByMotion, BearFramesThatShowSomethingElse) {
  const std::vector<Filmed> filmed = {{1}, {1.5}, {0.2}, {0.7}};
  std::vector<CameraHulls> cameras = FilmAll(filmed);
  for (std::size_t i = 40; i < 70; ++i)
    for (HullCorner& corner : cameras[1].frames[i].corners)
      corner.ray_W = (corner.ray_W + Vector3(0.1, 0.05, -0.1)).normalized();
  for (std::size_t i = 100; i < 120; ++i) cameras[2].frames[i].corners.clear();
  ExpectBegins(filmed, ClocksByMotion(cameras, std::vector<ClockFit>(4), [] {}), 0.003);
}

TEST(ClocksByMotion, KeepKnownClocks) {
  const std::vector<Filmed> filmed = {{1}, {1.5}, {0.2}};
  std::vector<ClockFit> known(3);
  known[1] = {50, 0, 0, 0, 1, true};
  const std::vector<ClockFit> clocks = ClocksByMotion(FilmAll(filmed), known, [] {});
  EXPECT_EQ(clocks[1].offset_s, 50);
  EXPECT_NEAR(clocks[0].offset_s, 49.5, 0.003);
  EXPECT_NEAR(clocks[2].offset_s, 48.7, 0.003);
}

TEST(ClocksByMotion, AreNotClearIfNobodyMoves) {
  std::vector<CameraHulls> cameras = FilmAll({{1}, {1.5}, {0.2}});
  for (CameraHulls& camera : cameras)
    for (SeenHull& hull : camera.frames) hull.corners = camera.frames[0].corners;
  for (const ClockFit& clock : ClocksByMotion(cameras, std::vector<ClockFit>(3), [] {}))
    EXPECT_LT(clock.clearness, 1.2);
}

TEST(ClocksByMotion, AreUnknownIfNobodyIsThere) {
  std::vector<CameraHulls> cameras = FilmAll({{1}, {1.5}});
  for (SeenHull& hull : cameras[1].frames) hull.corners.clear();
  const std::vector<ClockFit> clocks = ClocksByMotion(cameras, std::vector<ClockFit>(2), [] {});
  EXPECT_FALSE(clocks[0].is_known && clocks[1].is_known);
}

}  // namespace
}  // namespace mocap
