// An evaluation for terminals and programs.
#pragma once

#include <span>
#include <string>

#include "daemon/base/json.h"
#include "tools/report/evaluation.h"
#include "tools/report/hull_overlap.h"

namespace mocap {

/// Tables for a terminal.
std::string EvaluationText(const Evaluation& evaluation);

/// Adds one person's figures; angles in degrees.
void AddEvaluation(const Evaluation& evaluation, Json& json);

/// One JSON object; angles in degrees. `overlaps` may be empty.
std::string EvaluationJson(const Evaluation& evaluation, std::span<const CameraOverlap> overlaps);

}  // namespace mocap
