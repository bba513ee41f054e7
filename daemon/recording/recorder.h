// Starts and stops recordings, one at a time.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "daemon/recording/recording.h"

namespace mocap {

/// Owns the studio's taps and the current or last recording. Thread-safe.
class Recorder {
 public:
  explicit Recorder(RecordedStudio studio);

  /// The pipeline's threads offer their data here; valid for the recorder's life.
  RecordingTaps& taps() { return taps_; }

  /// Begins a take. @return the folder that it will have.
  /// @throws SetupError, std::runtime_error  as Recording, or if one is running.
  std::filesystem::path Start(const std::string& name, const RecordingConfig& config,
                              std::span<const RecordedPerson> people);
  /// Ends it. @return its result, also if it has ended by itself.
  /// @throws std::runtime_error  if there is none.
  RecordingStatus Stop();
  /// Whether a take is being recorded, or the last one has ended by itself.
  bool HasTake() const;
  /// Ends the take that is being recorded under this name, and removes what it holds.
  /// @throws std::runtime_error  if none is, or if it cannot be removed.
  void Cancel(const std::string& name);
  RecordingStatus Status() const;

 private:
  RecordingStatus StopRunning();

  const RecordedStudio studio_;
  RecordingTaps taps_;
  std::mutex change_mutex_;  ///< Held while a recording begins or ends, which takes time.
  mutable std::mutex mutex_;
  std::shared_ptr<Recording> recording_;
  RecordingStatus ended_;  ///< Of the recording before, while no other could begin.
};

/// Returns what a complete recording holds, how much of the disk it needs and what it lacks.
std::string CompletedText(const RecordingStatus& status);
/// "97 frame sets of 6 cameras, 0 frames dropped"; says when there is no frame, or no camera.
std::string ContentText(const RecordingStatus& status);

/// Folder of takes: as configured, or `takes` in the folder for state.
std::filesystem::path TakesFolder(const RecordingConfig& config);

}  // namespace mocap
