// HTML sections common to reports of one and of several people.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry.h"
#include "tools/report/evaluation.h"
#include "tools/report/hull_overlap.h"
#include "tools/take_samples.h"

namespace mocap {

/// A whole page. @param under  HTML below its title. @param body  HTML.
std::string ReportPage(const std::string& title, const std::string& under, const std::string& body);

/// A tile with one figure.
std::string Tile(const std::string& what, const std::string& value, const std::string& unit,
                 const std::string& under);

/// Names and positions p_WC.
std::vector<std::pair<std::string, Vector3>> CameraPlaces(const TakeSamples& samples);

/// All sections that need a tracked person.
std::string TrackingSections(const Evaluation& evaluation, const TakeSamples& samples);

/// Overlap of voxels and silhouettes. @param frames  numbers of the sampled moments.
std::string OverlapSection(std::span<const double> frames,
                           const std::vector<CameraOverlap>& overlaps);

}  // namespace mocap
