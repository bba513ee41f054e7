// Measures by how much one more camera makes the hulls of people smaller.
#pragma once

#include <string>

namespace mocap {

/// Returns the share of a hull that one more camera carves, 0 to 1: mean over the cameras of a
/// simulated studio, each left out once, from true masks of three people who walk.
/// @param cameras  how many the studio has, from 3.
double ShareCarvedByOneMore(int cameras);

/// Tells it for several numbers of cameras, beside the share that carving expects.
std::string CarvingLines();

}  // namespace mocap
