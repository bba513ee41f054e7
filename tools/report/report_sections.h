// What reports of one person and of several are made of, as HTML.
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

/// A figure at a glance.
std::string Tile(const std::string& what, const std::string& value, const std::string& unit,
                 const std::string& under);

/// Names and places p_WC.
std::vector<std::pair<std::string, Vector3>> CameraPlaces(const TakeSamples& samples);

/// Everything that only a tracked person makes possible.
std::string TrackingSections(const Evaluation& evaluation, const TakeSamples& samples);

/// How far voxels and silhouettes cover each other. @param frames  numbers of the sampled moments.
std::string OverlapSection(std::span<const double> frames,
                           const std::vector<CameraOverlap>& overlaps);

}  // namespace mocap
