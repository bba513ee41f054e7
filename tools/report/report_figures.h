// The report's figures, each an HTML <figure>. Some redraw the paper's with our data.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry.h"
#include "tools/report/evaluation.h"
#include "tools/report/hull_overlap.h"

namespace mocap {

/// State of each frame (searching, acquiring, tracking, lost), as a coloured band.
std::string StateTimeline(const Evaluation& evaluation);

/// Fig. 17: estimated and true sizes of the parts 0–9.
std::string PartSizesFigure(const Evaluation& evaluation);

/// Fig. 21: the path of the torso's centroid from above.
/// @param cameras  names and positions p_WC.
std::string TorsoPathFigure(const Evaluation& evaluation,
                            std::span<const std::pair<std::string, Vector3>> cameras);

/// Fig. 22: hip and knee angles over the frame number.
std::string HipKneeFigure(const Evaluation& evaluation);

/// The eight angles that can be computed from points, tracked and true. Empty without truth.
std::string ScoredAnglesFigure(const Evaluation& evaluation);

/// Distance of the points from the truth, frame by frame. Empty without truth.
std::string ErrorFigure(const Evaluation& evaluation);

/// The tracker's own residual and the number of voxels.
std::string ResidualFigure(const Evaluation& evaluation);

/// Overlap of projected voxels and silhouettes for each camera over the sampled frames.
std::string OverlapFigure(std::span<const CameraOverlap> overlaps, std::span<const double> frames);

}  // namespace mocap
