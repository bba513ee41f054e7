#include "drivers/simulation/floor_shadow.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "drivers/simulation/room_plan.h"
#include "drivers/simulation/scene.h"
#include "drivers/simulation/simulated_studio.h"

namespace mocap::simulation {
namespace {

TEST(FloorShadow, FallsOnlyWhereItMay) {
  const SimulatedStudioOptions options = RecordedSimulation();
  const Scene scene(options);
  std::vector<Eigen::Vector3f> p_W, n_W;
  SkinMesh(scene.mesh(), scene.person().BonesAt(options.start_ns), p_W, n_W);
  FloorShadow shadow;
  shadow.Cast(scene.mesh(), p_W);
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

}  // namespace
}  // namespace mocap::simulation
