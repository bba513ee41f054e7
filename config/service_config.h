// What a person may change about the daemon as a service: control, recording, metrics, priority.
#pragma once

#include <filesystem>
#include <vector>

#include "drivers/take/video_writer.h"

namespace mocap {

/// [control]: how the running daemon is told what to do.
struct ControlConfig {
  std::filesystem::path socket;  ///< Empty: `control` in the folder that systemd or XDG gives.
};

/// [recording]: where takes go and how.
struct RecordingConfig {
  std::filesystem::path folder;  ///< Empty: `takes` in the daemon's folder for state.
  VideoCodec codec = VideoCodec::kHuffYuv;
  double buffer_mb = 256;     ///< Frames that wait for the disk, of all cameras.
  double keep_free_mb = 500;  ///< A recording ends in good order when the disk has less.
};

/// [metrics]: figures for a program that collects them.
struct MetricsConfig {
  std::filesystem::path file;  ///< In Prometheus' text format; empty: none.
};

/// [realtime]: what lets frames go before everything else on a busy machine.
struct RealtimeConfig {
  int priority = 0;             ///< Of the frame path, SCHED_FIFO; 0: as everybody.
  bool lock_memory = false;     ///< Nothing is paged out.
  std::vector<int> processors;  ///< That the frame path keeps to; empty: all.
};

struct ServiceConfig {
  ControlConfig control;
  RecordingConfig recording;
  MetricsConfig metrics;
  RealtimeConfig realtime;
};

}  // namespace mocap
