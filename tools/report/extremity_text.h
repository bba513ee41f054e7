// Accuracy of hands, feet and head for terminals, programs and pages.
#pragma once

#include <string>

#include "daemon/base/json.h"
#include "tools/report/extremity_accuracy.h"

namespace mocap {

/// Tables for a terminal; empty without figures.
std::string ExtremityText(const ExtremityAccuracy& accuracy);

/// Fields: points_mm, angles_deg (mean and p95 of each), contacts and skating_mm (by heel and toe).
Json ExtremityJson(const ExtremityAccuracy& accuracy);

/// A section of a Markdown page; empty without figures. @param heading  with its number signs.
std::string ExtremityMarkdown(const std::string& heading, const ExtremityAccuracy& accuracy);

/// Tables of a report page.
Json ExtremitySections(const ExtremityAccuracy& accuracy);

}  // namespace mocap
