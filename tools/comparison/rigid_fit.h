// The rigid transform between two sets of points, in spite of outliers.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// Two places of one point: in the other recording and in ours [mm].
struct PlacePair {
  Vector3 other, own;
};

struct RigidFit {
  RigidTransform X;      ///< Takes other places to ours.
  double median_mm = 0;  ///< Of the distances that remain.
};

/// Fits by least squares (Kabsch 1976, with weights). Never mirrors.
/// @param weights  one per pair; empty: all alike.
/// @return  empty when the places lie on one line, or fewer than three pairs are given.
std::optional<RigidTransform> FitRigid(std::span<const PlacePair> pairs,
                                       std::span<const double> weights = {});

/// Fits with weights of Cauchy's loss, which far outliers do not move (Holland and Welsch 1977).
/// @param start  null: least squares.
std::optional<RigidFit> FitRobustly(std::span<const PlacePair> pairs,
                                    const RigidTransform* start = nullptr, int iterations = 20);

/// Standard deviation of one coordinate, of the median length of differences; not below what
/// recordings can show.
double RobustScale(double median_mm);
/// Weight of Cauchy's loss.
double CauchyWeight(double distance_mm, double scale_mm);

}  // namespace mocap
