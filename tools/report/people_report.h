// The report of `mocap evaluate` for several people: one HTML file, one colour per person.
#pragma once

#include <string>
#include <vector>

#include "tools/report/hull_overlap.h"
#include "tools/report/people_evaluation.h"
#include "tools/take_samples.h"

namespace mocap {

/// Chooses moments spread evenly over those with a tracked person: twenty to carve, four of them to
/// show.
std::vector<SampleRequest> ChooseReportMoments(const PeopleEvaluation& evaluation);

/// Writes the page.
std::string PeopleReportHtml(const PeopleEvaluation& evaluation, const TakeSamples& samples,
                             const std::vector<CameraOverlap>& overlaps);

}  // namespace mocap
