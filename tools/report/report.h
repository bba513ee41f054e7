// The report of `mocap evaluate`: one self-contained HTML file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/report/evaluation.h"
#include "tools/report/hull_overlap.h"
#include "tools/report/report_page.h"
#include "tools/take_samples.h"

namespace mocap {

/// Voxels are carved again for the report, with the daemon's default size.
inline constexpr double kReportVoxelMm = 25;

/// Chooses moments spread evenly over the tracked frames (over all, when none is tracked): twenty
/// to carve, four of them to show.
std::vector<SampleRequest> ChooseReportMoments(const Evaluation& evaluation);
/// Likewise for any times.
std::vector<SampleRequest> ChooseReportMoments(std::span<const std::int64_t> times_ns);

/// Measures the overlap of each moment's voxels with each camera's silhouette.
std::vector<CameraOverlap> MeasureOverlaps(const TakeSamples& samples);

/// The states of a person's frames, as a band. @param name  empty: alone.
Json StateBand(const std::string& name, int figure, const Evaluation& evaluation);
Json StateBands(Json people);

/// Writes the page.
std::string ReportHtml(const Evaluation& evaluation, const TakeSamples& samples,
                       const std::vector<CameraOverlap>& overlaps);

}  // namespace mocap
