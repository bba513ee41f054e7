// All figures about a result of several people, with and without truth.
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

/// One of the people whom the tracker followed.
struct TrackedPerson {
  std::string name;  ///< As person-1.
  /// With the truth of whom he was, frame by frame; without truth where he never was anybody.
  Evaluation evaluation;
  std::vector<PersonMatch> matches;
  int true_person = -1;  ///< Whom he was most often; -1: nobody.
  // Without truth 0:
  int phantom_frames = 0;    ///< Tracked where nobody is,
  int duplicate_frames = 0;  ///< or somebody whom another one follows already.
};

/// How one of the people who were there was followed.
struct FollowedTruth {
  int frames = 0;   ///< In the room,
  int covered = 0;  ///< and shown as a whole by enough pictures.
  int found = 0;    ///< Frames in which somebody tracked was he,
  int found_covered = 0;
  int switches = 0;    ///< How often he went on as somebody else of the tracked.
  double mean_mm = 0;  ///< Error over the frames in which he was found and all points.
};

struct PeopleEvaluation {
  std::string take;
  std::vector<TrackedPerson> people;
  std::vector<TruePerson> truth;        ///< Empty: the take has none.
  std::vector<FollowedTruth> followed;  ///< Of each of those.
  FollowedTruth sum;                    ///< Of all.
  int phantom_frames = 0;               ///< Likewise,
  int duplicate_frames = 0;             ///< and this.
};

/// Says how good results are that were tracked together.
/// @param people  by their names.
PeopleEvaluation EvaluatePeople(PeopleResults people, std::vector<TruePerson> truth);

/// Says how good a result of one person is; where there were several, it is held against whoever he
/// was in each frame.
Evaluation EvaluateOne(Result result, const std::vector<TruePerson>& truth);

/// Reads a take's truth and a result of one person, and compares them so.
/// @param prefix  of a result that is a log: see ReadResult.
/// @throws SetupError  when either cannot be read.
Evaluation EvaluateOne(const std::filesystem::path& take, const std::filesystem::path& result,
                       const std::optional<std::string>& prefix = {});

/// Reads a take's truth and a result of several people, and compares them.
/// @param prefix  of a result that is a log: see ReadPeople.
/// @throws SetupError  when either cannot be read.
PeopleEvaluation EvaluatePeople(const std::filesystem::path& take,
                                const std::filesystem::path& result,
                                const std::optional<std::string>& prefix = {});

}  // namespace mocap
