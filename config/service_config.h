// Settings of the daemon as a service: control, recording, metrics, priority.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "drivers/take/video_writer.h"

namespace mocap {

/// [control]: how the running daemon receives requests.
struct ControlConfig {
  std::filesystem::path socket;  ///< Empty: `control` in the runtime folder of systemd or XDG.
};

/// [recording]: destination and format of takes.
struct RecordingConfig {
  std::filesystem::path folder;  ///< Empty: `takes` in the daemon's state folder.
  VideoCodec codec = VideoCodec::kHuffYuv;
  double buffer_mb = 256;     ///< Memory for frames that wait for the disk, all cameras.
  double keep_free_mb = 500;  ///< A recording ends properly when less is free.
};

/// [metrics]: metrics for a program that collects them.
struct MetricsConfig {
  std::filesystem::path file;  ///< In Prometheus' text format; empty: none.
};

/// [realtime]: gives frames precedence on a busy machine.
struct RealtimeConfig {
  /// Of the frame path, SCHED_FIFO; 0: normal scheduling. Without a value, real-time if permitted.
  std::optional<int> priority;
  bool lock_memory = false;     ///< Nothing is paged out.
  std::vector<int> processors;  ///< For the frame path; empty: all.
};

struct ServiceConfig {
  ControlConfig control;
  RecordingConfig recording;
  MetricsConfig metrics;
  RealtimeConfig realtime;
};

}  // namespace mocap
