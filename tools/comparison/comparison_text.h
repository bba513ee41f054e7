// Comparisons as text and JSON.
#pragma once

#include <string>

#include "daemon/base/json.h"
#include "tools/comparison/comparison.h"

namespace mocap {

std::string ComparisonText(const Comparison& comparison);

/// What docs/compare.md describes: offset_s, points_rmsd_mm, angles_rmsd_deg and all else.
Json ComparisonJson(const Comparison& comparison);

/// "names of markers", "motion" …
std::string_view NameOf(PairedBy by);
/// "LLFC + LMFC"
std::string OthersOf(const PointComparison& point);

}  // namespace mocap
