// All figures for a result of several people, with and without truth.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/report/evaluation.h"
#include "tools/report/people_matching.h"
#include "tools/results/true_people.h"

namespace mocap {

/// One of the tracked people.
struct TrackedPerson {
  std::string name;  ///< Such as person-1.
  /// Against the matched true person, frame by frame; without truth if never matched.
  Evaluation evaluation;
  std::vector<PersonMatch> matches;
  int true_person = -1;  ///< Most frequent match; -1: none.
  // 0 without truth:
  int phantom_frames = 0;    ///< Tracked where nobody is.
  int duplicate_frames = 0;  ///< Tracked at someone whom another one already follows.
};

/// How well a true person was tracked.
struct FollowedTruth {
  int frames = 0;   ///< In the room.
  int covered = 0;  ///< Entirely visible in enough pictures.
  int found = 0;    ///< Frames in which a tracked person matched.
  int found_covered = 0;
  int switches = 0;    ///< Number of changes to another tracked person.
  double mean_mm = 0;  ///< Mean error over all points of the frames found.
};

struct PeopleEvaluation {
  std::string take;
  std::vector<TrackedPerson> people;
  std::vector<TruePerson> truth;        ///< Empty if the take has none.
  std::vector<FollowedTruth> followed;  ///< One per true person.
  FollowedTruth sum;                    ///< Of all.
  int phantom_frames = 0;               ///< Of all tracked people.
  int duplicate_frames = 0;             ///< Of all tracked people.
};

/// Computes the quality of results that were tracked together.
/// @param people  with their names.
PeopleEvaluation EvaluatePeople(PeopleResults people, std::vector<TruePerson> truth);

/// Computes the quality of one person's result. If there were several people, compares it with the
/// matching person in each frame.
Evaluation EvaluateOne(Result result, const std::vector<TruePerson>& truth);

/// Reads a take's truth and a result of one person, and compares them in this way.
/// @param prefix  for a result that is a log: see ReadResult.
/// @throws SetupError  when either cannot be read.
Evaluation EvaluateOne(const std::filesystem::path& take, const std::filesystem::path& result,
                       const std::optional<std::string>& prefix = {});

/// Reads a take's truth and a result of several people, and compares them.
/// @param prefix  for a result that is a log: see ReadPeople.
/// @throws SetupError  when either cannot be read.
PeopleEvaluation EvaluatePeople(const std::filesystem::path& take,
                                const std::filesystem::path& result,
                                const std::optional<std::string>& prefix = {});

}  // namespace mocap
