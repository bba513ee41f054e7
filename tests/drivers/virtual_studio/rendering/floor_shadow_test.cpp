#include "drivers/virtual_studio/rendering/floor_shadow.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "drivers/virtual_studio/room/room_plan.h"
#include "drivers/virtual_studio/scene.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap::simulation {
namespace {

TEST(FloorShadow, FallsOnlyWhereItMay) {
  const SimulatedStudioOptions options = RecordedSimulation();
  const Scene scene(options);
  std::vector<Eigen::Vector3f> p_W, n_W;
  const PersonMesh& mesh = scene.figures().front().mesh;
  SkinMesh(mesh, scene.people().front().BonesAt(options.start_ns), p_W, n_W);
  FloorShadow shadow;
  shadow.Clear();
  shadow.Cast(mesh, p_W);
  shadow.Blur();
  constexpr auto kEnd_x = static_cast<int>(kRoomX_mm * kFloorUnitsPerMm);
  constexpr auto kEnd_y = static_cast<int>(kRoomY_mm * kFloorUnitsPerMm);
  constexpr int kStep = 50;  // Less than a cell.
  int dark_rows = 0, rows = 0;
  for (int y = 0; y < kEnd_y; y += kStep) {
    std::vector<FloorPlace> places;
    for (int x = 0; x < kEnd_x; x += kStep)
      places.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    places.push_back({kNoFloor, 0});
    bool is_dark = false;
    for (const FloorPlace& place : places) is_dark |= shadow.LightAt(place) < 256;
    const bool may_be_dark = shadow.MayFallOn(places);
    EXPECT_TRUE(may_be_dark || !is_dark) << "in row " << y;
    dark_rows += is_dark;
    rows += may_be_dark;
  }
  // No row is missed, and few are looked at in vain.
  EXPECT_GT(dark_rows, 0);
  EXPECT_LE(rows, 3 * dark_rows / 2);
}

TEST(FloorShadow, OfTwoIsNowhereLighterThanOfEither) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.motion = "meet";
  options.people = 2;
  const Scene scene(options);
  const std::vector<BonePoses> poses = scene.BonesAt(options.start_ns);
  std::array<FloorShadow, 3> shadows;  // The first's, the second's, both.
  for (FloorShadow& shadow : shadows) shadow.Clear();
  for (int i = 0; i < 2; ++i) {
    std::vector<Eigen::Vector3f> p_W, n_W;
    SkinMesh(scene.figures()[i].mesh, poses[i], p_W, n_W);
    shadows[i].Cast(scene.figures()[i].mesh, p_W);
    shadows[2].Cast(scene.figures()[i].mesh, p_W);
  }
  for (FloorShadow& shadow : shadows) shadow.Blur();
  std::array<int, 2> dark{};
  for (int y = 0; y < kRoomY_mm * kFloorUnitsPerMm; y += 150)
    for (int x = 0; x < kRoomX_mm * kFloorUnitsPerMm; x += 150) {
      const FloorPlace place{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
      for (int i = 0; i < 2; ++i) {
        ASSERT_LE(shadows[2].LightAt(place), shadows[i].LightAt(place)) << x << ' ' << y;
        dark[i] += shadows[i].LightAt(place) < 256;
      }
    }
  EXPECT_GT(dark[0], 50);
  EXPECT_GT(dark[1], 50);
}

}  // namespace
}  // namespace mocap::simulation
