// Who belongs to whom: pairs of the largest sum.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace mocap {

/// Pairs rows with columns, one to one, so that the sum of what the pairs gain is the largest.
///
/// The Hungarian method with shortest augmenting paths (Jonker and Volgenant 1987), O(n³).
///
/// @param gain  rows × columns; a pair that gains nothing, 0 or less, is none.
/// @return      the column of each row; -1: none.
std::vector<int> AssignForMost(const Eigen::MatrixXd& gain);

}  // namespace mocap
