// An evaluation of several people for terminals and programs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tools/report/people_evaluation.h"

namespace mocap {

/// "1 person", "2 people".
std::string CountedPeople(std::size_t count);

/// Explains the columns "covered" and "switches" of true people.
inline constexpr std::string_view kTrueColumnsText =
    "covered: frames in which at least four cameras show the whole person (all, if take.toml does "
    "not say); switches: how often another track took over";

/// One row per tracked person, one per true person, and a summary.
std::string PeopleText(const PeopleEvaluation& evaluation);

/// One JSON object; each of `people` is as in EvaluationJson.
std::string PeopleJson(const PeopleEvaluation& evaluation);

}  // namespace mocap
