// Floor plan of the simulated studio [mm], world frame: the origin is the middle of the floor.
#pragma once

namespace mocap::simulation {

inline constexpr double kRoomX_mm = 6500, kRoomY_mm = 6400, kRoomZ_mm = 3000;

/// The door is an opening in the wall at -x; behind it a corridor runs along the wall.
inline constexpr double kDoorX_mm = -kRoomX_mm / 2, kDoorY_mm = 700;
inline constexpr double kDoorWidth_mm = 950, kDoorHeight_mm = 2150, kDoorJamb_mm = 320;
inline constexpr double kCorridorDepth_mm = 1100, kCorridorHalfLength_mm = 3800;
/// Distance along the corridor beyond which nobody is visible from the room.
inline constexpr double kHidingPlace_mm = 3000;

}  // namespace mocap::simulation
