// Recorded takes with truth, each tracked from several first sets.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/accuracy/first_sets.h"
#include "tools/report/extremity_accuracy.h"

namespace mocap {

/// A folder of takes.
struct TakesFolder {
  std::string name;
  std::vector<std::filesystem::path> takes;  ///< With truth, by name.
  std::vector<std::string> remarks = {};     ///< Takes left out, one line each.
};

/// Finds the takes with truth in folders. A folder may be a take itself.
/// @throws SetupError  when a folder has none, two have the same name, or a truth is damaged.
std::vector<TakesFolder> FoldersOfTakes(const std::vector<std::filesystem::path>& folders);

/// How well a person of a take was tracked.
struct TakePerson {
  std::string name;  ///< The take's; of several people also the person's: two_meet/person-1.
  PersonScore score;
  int switches = 0;                    ///< Of all runs.
  ExtremityAccuracy extremities = {};  ///< Mean of the runs.
};

/// Several runs on one take.
struct ScoredTake {
  std::vector<TakePerson> people;
  int stray_sets = 0;  ///< Phantoms and duplicates, of all people and runs.
};

/// The takes of one folder.
struct ScoredTakes {
  std::string folder;
  std::vector<ScoredTake> takes;
};

/// Tracks a take as `mocap track` does, with `--people` if its truth has several people. The k-th
/// run begins with set k. All are scored in the sets from the last one's first on.
/// @param firsts  number of runs, at least one.
/// @throws SetupError  when the take cannot be opened, or has fewer sets than that.
ScoredTake RunTakeTrial(const std::filesystem::path& take, int firsts);

/// Of hands, feet and head: means over the people of a folder.
ExtremityAccuracy MeanExtremities(const ScoredTakes& rows);

/// Header of TakeLines' columns.
std::string TakesHeader();
/// A line for each person.
std::string TakeLines(const ScoredTake& row);
/// Means over the people of a folder, the worst spread, switches and phantoms.
std::string TakesSummaryText(const ScoredTakes& rows);
/// A table of all people, folder by folder; nothing without folders.
std::string TakesMarkdown(const std::vector<ScoredTakes>& folders, int firsts);

}  // namespace mocap
