// The figures of the report, each an HTML <figure>; the paper's drawn again from our data.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry.h"
#include "tools/report/evaluation.h"
#include "tools/report/hull_overlap.h"

namespace mocap {

/// Where each frame was searched, acquired, tracked or lost, as a coloured band.
std::string StateTimeline(const Evaluation& evaluation);

/// Fig. 17: sizes of the parts 0–9 and the true ones.
std::string PartSizesFigure(const Evaluation& evaluation);

/// Fig. 21: the way of the torso's centroid seen from above.
/// @param cameras  names and places p_WC.
std::string TorsoPathFigure(const Evaluation& evaluation,
                            std::span<const std::pair<std::string, Vector3>> cameras);

/// Fig. 22: hip and knee angles over the frame number.
std::string HipKneeFigure(const Evaluation& evaluation);

/// The eight angles that follow from points, tracked and true. Empty without truth.
std::string ScoredAnglesFigure(const Evaluation& evaluation);

/// Distance of the points from the truth, frame by frame. Empty without truth.
std::string ErrorFigure(const Evaluation& evaluation);

/// The tracker's own residual and the number of voxels.
std::string ResidualFigure(const Evaluation& evaluation);

/// Overlap of projected voxels and silhouettes for each camera over the sampled frames.
std::string OverlapFigure(std::span<const CameraOverlap> overlaps, std::span<const double> frames);

}  // namespace mocap
