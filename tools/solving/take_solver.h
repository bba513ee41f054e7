// The passes of a solve after the first: paths, sizes, smoothed poses.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tools/solving/filtered_motion.h"
#include "tools/solving/solve_files.h"

namespace mocap {

/// Tells how far a solve is, such as "person 1: path, part 2 of 9".
using TellProgress = std::function<void(const std::string&)>;

/// A person of a take, solved.
struct SolvedPerson {
  BodyModel body;
  std::vector<SolvedPose> poses;  ///< In order of time; sets without a pose are left out.
};

struct TakeSolverOptions {
  int jobs = 1;          ///< Threads.
  int fineness = 1;      ///< As in PeopleOptions.
  bool measures = true;  ///< Whether sizes are unknown.
  TellProgress tell = [](const std::string&) {};
};

/// Solves everybody of a take. Parts of a path that the files have are not found again.
/// @return  by number.
std::map<int, SolvedPerson> SolvePeople(const SolveFiles& files, const FirstPass& pass,
                                        const TakeSolverOptions& options);

}  // namespace mocap
