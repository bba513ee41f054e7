// One take being recorded while tracking goes on.
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
#include "daemon/recording/message_log.h"
#include "daemon/recording/safe_file.h"
#include "drivers/background_source.h"
#include "drivers/studio.h"
#include "drivers/take/take_writer.h"

namespace mocap {

/// Facts about a camera that a recording needs.
struct RecordedCamera {
  CameraCalibration calibration;
  BackgroundSource background;
};

/// The studio as a recording sees it.
struct RecordedStudio {
  std::string name;
  double fps_nominal = 30;
  std::vector<RecordedCamera> cameras;
  std::string config_text;  ///< Kept in the take; empty: there is none.
  CaptureTimes times = CaptureTimes::kPresent;
};

/// Where the pipeline's threads leave what they have, in the order of the cameras.
struct RecordingTaps {
  std::deque<FrameTap> frames;
  MessageTap messages;
};

/// How a recording does, or did.
struct RecordingStatus {
  enum class State { kNone, kRunning, kComplete, kFailed };
  State state = State::kNone;
  std::filesystem::path folder;
  std::int64_t duration_ns = 0;
  std::int64_t frames = 0;         ///< Written, of all cameras.
  std::int64_t waiting = 0;        ///< In memory, likewise: what a kill would cost.
  std::int64_t dropped = 0;        ///< Came from the cameras and had no room in memory, likewise.
  std::optional<LossCause> cause;  ///< Of the latest that were dropped.
  std::string problem;             ///< Why it ended by itself.
};

/// How much of a computer's memory frames may take while they wait: what is configured, but no more
/// than half of it.
double BufferFor(const RecordingConfig& config, double memory_mb);

/// Somebody who is in the room when a recording begins.
struct RecordedPerson {
  int id = 0;        ///< As on MOCAP_PEOPLE.
  std::string name;  ///< Empty: none.
  BodySizes sizes;
};

/// Records until Stop, until the disk is nearly full or until something cannot be written.
///
/// One thread a camera codes and writes, when nobody else wants the processor or frames have
/// waited; one writes messages, keeps what is written safe from a loss of power and completes the
/// take. Frames wait in memory as long as there is room. A camera that cannot be written ends the
/// recording; what the others have by then is written still.
class Recording {
 public:
  /// Stores what a take needs to be opened, whatever comes, and begins: frames are kept from the
  /// return on.
  /// @param folder   of the take to be. @param people  whose sizes are known.
  /// @param taps     borrowed for the recording's life.
  /// @throws SetupError          when the folder cannot be made, or there is too little room.
  /// @throws std::runtime_error  when something cannot be written; nothing is left then, unless it
  /// is frames.
  Recording(const std::filesystem::path& folder, const RecordingConfig& config,
            const RecordedStudio& studio, std::span<const RecordedPerson> people,
            RecordingTaps& taps);
  /// Stops.
  ~Recording();

  /// Writes what waits and completes the take, which takes its time.
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
  void WriteMessages();
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
  std::optional<MessageLog> log_;
  std::optional<SafeFile> safe_log_;
  std::vector<std::unique_ptr<Line>> lines_;
  Doorbell keeper_bell_;
  std::latch backgrounds_;  ///< Counted down by each camera whose empty studio is stored.
  std::latch begun_{1};     ///< Frames are kept from here on.
  std::int64_t begin_ns_ = 0;
  /// From capture times to those of the take: the time of day as it was when the take began.
  std::int64_t time_of_day_ahead_ns_ = 0;
  std::atomic<std::int64_t> end_ns_{0};
  std::atomic<bool> stop_{false};
  std::atomic<bool> has_failed_{false};
  mutable std::mutex mutex_;  ///< Of what follows.
  RecordingStatus::State state_ = RecordingStatus::State::kRunning;
  std::filesystem::path place_;  ///< Where the take is by now.
  std::string problem_;
  std::optional<LossCause> last_cause_;
  std::optional<CoderWatch> watch_;  ///< While coders run.
  const bool can_return_;            ///< Whether threads may go behind and come forward again.
  std::thread keeper_;
};

}  // namespace mocap
