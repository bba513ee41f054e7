// Starts and stops recordings, one at a time.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "daemon/recording/recording.h"

namespace mocap {

/// Holds the studio's taps and the recording that is on, or was last. Thread-safe.
class Recorder {
 public:
  explicit Recorder(RecordedStudio studio);

  /// Where the pipeline's threads leave what they have; for the recorder's life.
  RecordingTaps& taps() { return taps_; }

  /// Begins a take. @return its folder to be.
  /// @throws SetupError, std::runtime_error  as Recording, and when one is on already.
  std::filesystem::path Start(const std::string& name, const RecordingConfig& config,
                              std::span<const RecordedPerson> people);
  /// Ends it. @return how it went, also when it has ended by itself.
  /// @throws std::runtime_error  when there is none.
  RecordingStatus Stop();
  RecordingStatus Status() const;

 private:
  const RecordedStudio studio_;
  RecordingTaps taps_;
  std::mutex change_mutex_;  ///< Held while a recording begins or ends, which takes time.
  mutable std::mutex mutex_;
  std::shared_ptr<Recording> recording_;
};

/// Where takes go: as configured, or `takes` in the folder for state.
std::filesystem::path TakesFolder(const RecordingConfig& config);

}  // namespace mocap
