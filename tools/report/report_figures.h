// Figures of one person for the report: what mocap evaluate measured, as sections of a page.
#pragma once

#include <span>

#include "tools/report/evaluation.h"
#include "tools/report/hull_overlap.h"
#include "tools/report/report_page.h"
#include "tools/take_samples.h"

namespace mocap {

/// The colours of left and right, and of what has no side.
inline constexpr int kLeftFigure = 0, kRightFigure = 1, kPlainFigure = 2, kOtherFigure = 3;

/// The axis of curves with a value for each row of a result.
Json FrameAxis(const Evaluation& evaluation);

/// The mean distance of the points from the truth at each row; null where it is unknown.
Json ErrorCurve(const Evaluation& evaluation);

/// The path of the torso's centroid from above [m].
Json TorsoPath(const Evaluation& evaluation, const std::string& label, int figure);

/// A plan with the cameras and these paths, as in the paper's Fig. 21.
Json PathsFigure(const std::string& title, const TakeSamples& samples, Json paths);

/// All sections that need a tracked person.
Json TrackingSections(const Evaluation& evaluation, const TakeSamples& samples);

/// Overlap of projected voxels and silhouettes. @param frames  numbers of the sampled moments.
Json OverlapSections(std::span<const double> frames, std::span<const CameraOverlap> overlaps);

}  // namespace mocap
