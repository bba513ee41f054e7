// Records one take while tracking continues.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <latch>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "config/service_config.h"
#include "core/body/body_sizes.h"
#include "core/reconstruction/camera/camera_model.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/tap.h"
#include "daemon/recording/coder_watch.h"
#include "daemon/recording/message_keeper.h"
#include "daemon/recording/recording_taps.h"
#include "daemon/recording/safe_file.h"
#include "drivers/background_source.h"
#include "drivers/studio.h"
#include "drivers/take/take_writer.h"

namespace mocap {

/// What a recording needs to know of a camera.
struct RecordedCamera {
  CameraCalibration calibration;
  BackgroundSource background;
};

/// What a recording needs to know of the studio.
struct RecordedStudio {
  std::string name;
  double fps_nominal = 30;
  std::vector<RecordedCamera> cameras;
  std::string config_text;  ///< Stored in the take; empty: none.
  CaptureTimes times = CaptureTimes::kPresent;
};

/// The status of a current or past recording.
struct RecordingStatus {
  enum class State { kNone, kRunning, kComplete, kFailed };
  State state = State::kNone;
  std::filesystem::path folder;
  std::int64_t duration_ns = 0;
  std::size_t cameras = 0;
  std::int64_t frames = 0;         ///< Written, all cameras.
  std::int64_t sets = 0;           ///< Frames of the camera that has the most.
  std::int64_t waiting = 0;        ///< In memory, all cameras: lost if the process is killed.
  std::int64_t dropped = 0;        ///< Captured, but without room in memory; all cameras.
  std::optional<LossCause> cause;  ///< Of the latest drops.
  std::string problem;             ///< Why it ended by itself.
};

/// Memory for waiting frames: as configured, but no more than half of the computer's memory.
double BufferFor(const RecordingConfig& config, double memory_mb);

/// A person in the room when a recording begins.
struct RecordedPerson {
  int id = 0;        ///< As on MOCAP_PEOPLE.
  std::string name;  ///< Empty: none.
  BodySizes sizes;
};

/// Records until Stop, until the disk is nearly full, or until writing fails.
///
/// One thread per camera codes and writes, when the processor is idle or frames have waited.
/// Another one writes messages, syncs files against power loss and completes the take. Frames wait
/// in memory while there is room. If a camera's file cannot be written, the recording ends; frames
/// that the others already have are still written.
class Recording {
 public:
  /// Stores what is needed to open the take in any event, then begins: frames are kept from the
  /// return on.
  /// @param folder   of the future take. @param people  those whose sizes are known.
  /// @param taps     borrowed for the recording's life.
  /// @throws SetupError          if the folder cannot be created, or space is short.
  /// @throws std::runtime_error  if something cannot be written. Then nothing is left, except when
  /// there are frames.
  Recording(const std::filesystem::path& folder, const RecordingConfig& config,
            const RecordedStudio& studio, std::span<const RecordedPerson> people,
            RecordingTaps& taps);
  /// Stops.
  ~Recording();

  /// Writes waiting frames and completes the take. This takes time.
  void Stop();
  /// Any thread.
  RecordingStatus Status() const;

 private:
  struct Line;

  void Prepare(std::span<const RecordedPerson> people);
  void Discard();
  void Begin();
  void RunCamera(std::size_t camera);
  void WriteFrames(std::size_t camera);
  void WriteFrame(std::size_t camera, const TappedFrame& frame);
  void RunKeeper();
  void KeepUntilStopped();
  void EndWatch();
  void KeepSafe();
  void Complete();
  void CloseFiles();
  void End();
  void Fail(const std::string& problem);
  template <typename Body>
  void Guard(Body body);

  const RecordingConfig config_;
  const RecordedStudio& studio_;
  RecordingTaps& taps_;
  std::optional<TakeWriter> writer_;
  const std::filesystem::path folder_;
  const std::filesystem::path partial_;
  std::optional<MessageKeeper> messages_;
  std::optional<SafeFile> safe_log_;
  std::vector<std::unique_ptr<Line>> lines_;
  Doorbell keeper_bell_;
  std::latch backgrounds_;  ///< Counted down when a camera's background is stored.
  std::latch begun_{1};     ///< Frames are kept from here on.
  std::int64_t begin_ns_ = 0;
  /// From capture times to the take's times: the time of day as of its beginning.
  std::int64_t time_of_day_ahead_ns_ = 0;
  std::atomic<std::int64_t> end_ns_{0};
  std::atomic<bool> stop_{false};
  std::atomic<bool> has_failed_{false};
  mutable std::mutex mutex_;  ///< Guards what follows.
  RecordingStatus::State state_ = RecordingStatus::State::kRunning;
  std::filesystem::path place_;  ///< Present folder of the take.
  std::string problem_;
  std::optional<LossCause> last_cause_;
  std::optional<CoderWatch> watch_;  ///< While coders run.
  const bool can_return_;  ///< Whether threads may lower their priority and raise it again.
  std::thread keeper_;
};

}  // namespace mocap
