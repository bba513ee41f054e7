// Beyond the paper: tests whether enough cameras confirm a newcomer.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>

#include "core/reconstruction/carving/carving_view.h"

namespace mocap {

/// Returns how many of the cameras in a set must show a newcomer where nobody else is.
int WitnessesWanted(std::size_t cameras);

/// Whether enough cameras have a whole person in their pictures, so that they do not show only a
/// part, also after a move by `beside_mm` [mm]. Feet stand on the floor.
bool IsCovered(const Eigen::AlignedBox3d& flesh_W, double beside_mm,
               std::span<const CameraEye> eyes);

}  // namespace mocap
