// Keeps what is said during a recording.
#pragma once

#include <cstdint>
#include <filesystem>

#include "daemon/pipeline/doorbell.h"
#include "daemon/recording/keypoint_file.h"
#include "daemon/recording/message_log.h"
#include "daemon/recording/recording_taps.h"

namespace mocap {

/// Writes messages and keypoints into a take. Thread-bound.
class MessageKeeper {
 public:
  /// @param folder  of the take. @param taps  borrowed for the keeper's life.
  /// @throws std::runtime_error  here and below, if something cannot be written.
  MessageKeeper(const std::filesystem::path& folder, RecordingTaps& taps);
  /// Frees the taps' memory. @pre  they are closed, or never were open.
  ~MessageKeeper();
  MessageKeeper(const MessageKeeper&) = delete;
  MessageKeeper& operator=(const MessageKeeper&) = delete;

  /// From now on, the taps keep what is offered. @param bell  as Tap::Open.
  void Open(Doorbell& bell);
  void Close();
  /// Writes what the taps have. @param ahead_ns  from the timeline to the take's times.
  /// @pre  Open was called.
  void Write(std::int64_t ahead_ns);

 private:
  void WriteMessages(MessageTap& tap, std::int64_t ahead_ns);

  RecordingTaps& taps_;
  MessageLog log_;
  KeypointFile keypoints_;
};

}  // namespace mocap
