// The noise of each kind of evidence. `mocap benchmark --parts noise` measures it at true poses.
// The degrees of freedom and scales of rays, voxels, borders and the floor are its, but for rays
// within the body (6.3 mm there): with 9 mm people like ours and people in takes of several were 2
// to 3 % better, those of other makers 3 % worse. Those of flesh and overlap are chosen: nine of
// ten bones and nearly all limbs have a residual of exactly 0, which no such distribution
// describes.
#pragma once

#include "core/objective/residual_noise.h"

namespace mocap {

/// Rays that graze the person, about the body's surface.
inline constexpr ResidualNoise kRayNoise{.freedom = 1.8, .inside_mm = 9, .outside_mm = 16};
/// Voxels of the hull's surface, about the body's surface.
inline constexpr ResidualNoise kSurfaceNoise{.freedom = 4.6, .inside_mm = 12.7, .outside_mm = 32.5};
/// Flesh beyond the border of a silhouette; for each camera, because cameras show the same flesh.
inline constexpr ResidualNoise kBorderNoise{
    .freedom = 2.0, .inside_mm = 11.2, .outside_mm = 11.2, .alike = 0.75};
/// Bones outside of the flesh.
inline constexpr ResidualNoise kFleshNoise{
    .freedom = 2.0, .inside_mm = 20, .outside_mm = 20, .alike = 3};
/// Depth of limbs within other parts.
inline constexpr ResidualNoise kOverlapNoise{
    .freedom = 10.0, .inside_mm = 23, .outside_mm = 23, .alike = 1};
/// Depth of parts below the floor, of those that reach below it.
inline constexpr ResidualNoise kFloorNoise{.freedom = 8.7, .inside_mm = 21.8, .outside_mm = 21.8};

/// A frame set has this many independent rays and voxels, however many are looked at. The benchmark
/// finds 175 and 126 by parts of the body; ghosts of a hull are voxels that err alike all over.
inline constexpr double kIndependentRays = 128, kIndependentVoxels = 30;

}  // namespace mocap
