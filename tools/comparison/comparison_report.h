// A page that shows a comparison.
#pragma once

#include <string>

#include "tools/comparison/comparison.h"

namespace mocap {

/// Writes figures, tables, curves and Bland-Altman plots as a page.
std::string ComparisonReportHtml(const std::string& title, const Comparison& comparison);

}  // namespace mocap
