// Beyond the paper: whether cameras vouch for somebody who is new.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>

#include "core/reconstruction/carving/carving_view.h"

namespace mocap {

/// How many cameras have to show a newcomer where nobody else is, of so many that are in.
int WitnessesWanted(std::size_t cameras);

/// Whether enough cameras have all of a person in their pictures, so that what they show is no part
/// of him, and would have it if he were so far beside [mm]. Feet stand on the floor.
bool IsCovered(const Eigen::AlignedBox3d& flesh_W, double beside_mm,
               std::span<const CameraEye> eyes);

}  // namespace mocap
