// The common clock of videos that were recorded without one.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/take/video_index.h"
#include "tools/import/pair_offsets.h"
#include "tools/import/silhouette_hull.h"
#include "tools/import/sound_travel.h"

namespace mocap {

enum class SyncMethod { kNone, kGiven, kTimecode, kClock, kSound, kMotion };
inline constexpr const char* kSyncNames[] = {"none",  "given", "timecode",
                                             "clock", "sound", "motion"};

/// What the user says about it.
struct SyncRequest {
  std::optional<SyncMethod> method;       ///< Empty: whatever works.
  std::map<std::string, double> given_s;  ///< Offsets by camera.
};

/// A recording to be synchronized.
struct SyncVideo {
  std::string camera;
  std::filesystem::path file;
  const VideoIndex* index = nullptr;
  SoundTravel travel = {};
};

/// A recording's place on the common clock.
struct CameraClock {
  SyncMethod method = SyncMethod::kNone;
  ClockFit fit;

  double TimeOf(std::int64_t file_ns) const {
    const double file_s = static_cast<double>(file_ns) / 1e9;
    return fit.offset_s + file_s * (1 + fit.rate_ppm * 1e-6);
  }
};

/// Uses what needs no pictures: given offsets, timecodes, sound, and the clocks in the files.
/// @param remarks  gets what was doubtful, one line each.
/// @param check    called again and again; may throw to end.
/// @throws SetupError  when the wanted method cannot be used, by camera.
std::vector<CameraClock> SyncByFiles(std::span<const SyncVideo> videos, const SyncRequest& request,
                                     std::vector<std::string>& remarks,
                                     const std::function<void()>& check);

/// Whether pictures must tell the rest.
bool NeedsMotion(const std::vector<CameraClock>& clocks);

/// What cameras saw, in two ways: bystanders whom not all cameras see disturb the first one, and
/// several people the second.
struct MotionSeen {
  std::vector<CameraHulls> everybody, largest;
};

/// Finds the clocks that are missing by motion, or by the clocks in the files if nothing else is
/// left.
/// @param seen  by all cameras. The largest count where everybody together is not clear.
/// @throws SetupError  naming the cameras that cannot be synchronized.
void SyncByMotion(std::span<const SyncVideo> videos, const MotionSeen& seen,
                  const SyncRequest& request, std::vector<std::string>& remarks,
                  const std::function<void()>& check, std::vector<CameraClock>& clocks);

/// Parses offsets: a TOML file of `camera = seconds`, or "cam1=0.2,cam2=-0.1".
/// @throws SetupError  also for a name that is no camera.
std::map<std::string, double> ParseOffsets(const std::string& text,
                                           const std::vector<std::string>& cameras);

}  // namespace mocap
