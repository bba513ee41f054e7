// The report of `mocap gait`: a page with figures, events and curves.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/gait/gait_analysis.h"

namespace mocap {

/// People with their names; a single one's may be empty.
using PeopleGaits = std::vector<std::pair<std::string, GaitAnalysis>>;

/// Writes the page.
std::string GaitReportHtml(const std::string& title, const PeopleGaits& people);

}  // namespace mocap
