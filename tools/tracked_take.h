// What `mocap track` and `mocap solve` have in common: a take, and the folder of its result.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "daemon/pipeline/frame_path.h"
#include "drivers/studio.h"
#include "drivers/take/unfinished_folder.h"
#include "tools/results/result.h"

namespace mocap {

/// What is asked for.
struct TrackedTake {
  std::string command;  ///< For messages: track or solve.
  std::filesystem::path take = {};
  std::filesystem::path out = {};
  std::vector<std::string> cameras = {};            ///< Empty: all.
  std::optional<std::filesystem::path> masks = {};  ///< An empty path: the take's own.
  std::optional<int> people = {};                   ///< Without: one, whose result is the take's.
};

/// Adds TAKE, --out, --cameras, --people and --masks. @param tracked  outlives the
/// command.
void AddTakeOptions(CLI::App& command, TrackedTake& tracked);

/// Opens the take and tells its remarks.
/// @throws SetupError  also for fewer than two cameras, or cameras that enclose no room.
Studio OpenTrackedTake(const TrackedTake& tracked, double voxel_mm);
/// Opens masks instead of pictures; null if none are asked for.
OpenElsewhere MaskedCamerasOf(const TrackedTake& tracked, Studio& studio);
/// The person's sizes, if the take contains them.
std::optional<KnownPerson> SubjectOf(const TrackedTake& tracked);
/// Checks that the result can be written.
/// @param new_folder  set if there was none, to be finished.
void RequireOut(const TrackedTake& tracked, std::optional<UnfinishedFolder>& new_folder);

/// Says what is wrong with the cameras, or why nobody was tracked.
/// @param sets  in which somebody was tracked.
/// @throws std::runtime_error  if nobody was tracked, because of the calibration or where an
/// earlier result has poses: a result is replaced only by a result.
void TellFault(const TrackedTake& tracked, const std::vector<CameraCalibration>& cameras,
               std::span<const SeenMoment> moments, std::size_t sets);

/// Writes the result of the person, or those of all people, and says what it removes of an earlier
/// one without writing it anew.
void WriteTracked(const TrackedTake& tracked, const Result& first,
                  const std::map<int, Result>& people);

}  // namespace mocap
