// Solves a take as a whole: every pose is decided by what was seen before and after.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/body/body_table.h"
#include "daemon/pipeline/frame_path.h"
#include "daemon/pipeline/pose_sink.h"
#include "drivers/studio.h"
#include "tools/results/result.h"
#include "tools/solving/take_solver.h"

namespace mocap {

struct SolveOptions {
  double voxel_mm = 25;
  std::optional<int> people = {};  ///< Empty: one.
  NamedFilter filter = {};
  std::filesystem::path work;      ///< Folder for what is too large for memory.
  std::string mark = {};           ///< Of take and options: a folder of the same goes on.
  int jobs = 1;                    ///< Threads.
  OpenElsewhere masked = nullptr;  ///< As in PipelineOptions.
  /// Known sizes of the person: nothing is measured live.
  std::optional<KnownPerson> subject = {};
  std::optional<TakeMark> take = {};
  PoseSink* live = nullptr;  ///< Gets every set of the first pass; not where that was done before.
  TellProgress tell = [](const std::string&) {};
};

struct Solved {
  std::map<int, Result> people;          ///< By number; 1 for the one person.
  std::vector<SeenMoment> moments = {};  ///< What the cameras saw now and then in the first pass.
  std::size_t sets = 0;
};

/// The same input gives the same result, for any number of jobs, and however often it was cut off.
/// @throws std::runtime_error  when the work folder cannot be written, or the command is stopped.
Solved SolveStudio(Studio studio, const BodyTable& body, const SolveOptions& options);

}  // namespace mocap
