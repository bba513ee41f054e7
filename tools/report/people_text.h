// An evaluation of several people for terminals and programs.
#pragma once

#include <cstddef>
#include <string>

#include "tools/report/people_evaluation.h"

namespace mocap {

/// "1 person", "2 people".
std::string CountedPeople(std::size_t count);

/// One row per tracked person, one per true person, and a summary.
std::string PeopleText(const PeopleEvaluation& evaluation);

/// One JSON object; each of `people` is as in EvaluationJson.
std::string PeopleJson(const PeopleEvaluation& evaluation);

}  // namespace mocap
