// mocap background learn --occupied: the background of a studio in which people move about.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mocap {

struct OccupiedOptions {
  double seconds = 60;                ///< Recording time of live cameras.
  std::vector<std::string> accepted;  ///< Cameras whose moved things become part of the background.
};

/// Records the configuration's cameras, all at the same time, and replaces their background. Prints
/// what was learned.
/// @throws SetupError  also for a camera on a pan-tilt head, as LearnOccupied, and for an accepted
/// camera that is not there. Then the old background stays.
void LearnFromOccupiedStudio(const std::filesystem::path& config, const OccupiedOptions& options);

/// Learns from a take's own pictures, and replaces its background, or gives it one. @throws
/// likewise.
/// @param config  of the studio that recorded it, whose background is replaced instead; may be
/// empty.
void LearnFromOccupiedTake(const std::filesystem::path& take, const std::filesystem::path& config,
                           const OccupiedOptions& options);

/// Asks the running mocapd to learn, waits for it, and prints what was learned. The cameras go on
/// meanwhile. @param socket  empty: the system's daemon, or the user's own.
/// @throws SetupError, std::runtime_error  for a refusal or failure.
void AskToLearn(const std::filesystem::path& socket, const OccupiedOptions& options);

}  // namespace mocap
