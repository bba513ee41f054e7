// An evaluation of several people for a terminal and for programs.
#pragma once

#include <cstddef>
#include <string>

#include "tools/report/people_evaluation.h"

namespace mocap {

/// "1 person", "2 people".
std::string CountedPeople(std::size_t count);

/// A row a tracked person, a row a true one, and what becomes of all.
std::string PeopleText(const PeopleEvaluation& evaluation);

/// One JSON object; `people` has for each what EvaluationJson has for one.
std::string PeopleJson(const PeopleEvaluation& evaluation);

}  // namespace mocap
