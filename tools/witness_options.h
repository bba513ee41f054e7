// What may be asked of a witness.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"

namespace mocap {

struct WitnessOptions {
  std::filesystem::path take = {};        ///< Empty: what mocapd sees now.
  std::filesystem::path model = {};       ///< Empty: the fetched one.
  std::filesystem::path out = {};         ///< Of keypoints; when fetching, a folder.
  double rate_hz = 3;                     ///< Looks at each person.
  std::optional<int> people = {};         ///< Without: one.
  std::vector<std::string> cameras = {};  ///< Empty: all.
  std::string url = LcmConfig().url;
  std::string prefix = {};
  double share_percent = 100;  ///< Of one processor's time, when live.
  bool fetch = false;
};

/// Adds TAKE and the options. @param options  outlives the command.
void AddWitnessOptions(CLI::App& command, WitnessOptions& options);

}  // namespace mocap
