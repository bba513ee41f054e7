// What an unfinished solve has found so far, on disk: it goes on where it was cut off.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/solving/person_track.h"
#include "core/solving/pose_path.h"
#include "tools/solving/set_spool.h"

namespace mocap {

/// What the first pass has found.
struct FirstPass {
  SpoolIndex index;
  std::map<int, PersonTrack> tracks;  ///< By people's numbers.
};

/// A folder with the files of a solve.
class SolveFiles {
 public:
  /// Creates the folder, or goes on with it. @param mark  of take and options: files of another
  /// mark are removed.
  /// @throws SetupError  for a folder of other files.
  /// @throws std::runtime_error  here and below, when a file cannot be written.
  SolveFiles(const std::filesystem::path& folder, const std::string& mark);

  /// Of the carved sets.
  std::filesystem::path Sets() const { return folder_ / "sets"; }

  /// Empty: it was not finished.
  std::optional<FirstPass> LoadFirstPass(const BodyTable& table) const;
  void Save(const FirstPass& pass) const;

  /// The parts of a person's path, as far as they were finished.
  std::vector<std::vector<PathStep>> LoadPath(int number) const;
  void AppendPath(int number, std::span<const PathStep> part) const;

 private:
  std::filesystem::path PathFile(int number) const;

  const std::filesystem::path folder_;
};

}  // namespace mocap
