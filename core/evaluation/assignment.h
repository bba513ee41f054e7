// Assignment with the largest total gain.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace mocap {

/// Matches rows with columns, one to one, so that the total gain is largest.
///
/// The Hungarian method with shortest augmenting paths (Jonker and Volgenant 1987), O(n³).
///
/// @param gain  rows × columns; pairs with a gain of 0 or less are not made.
/// @return      the column of each row; -1: none.
std::vector<int> AssignForMost(const Eigen::MatrixXd& gain);

}  // namespace mocap
