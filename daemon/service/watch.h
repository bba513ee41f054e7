// The main thread's work while the pipeline runs: status, log, systemd, terminal line.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <future>
#include <optional>
#include <string>

#include "daemon/messages/channel_watch.h"
#include "daemon/nodes/node_listener.h"
#include "daemon/nodes/silhouette_sender.h"
#include "daemon/nodes/studio_listener.h"
#include "daemon/pipeline/frame_progress.h"
#include "daemon/pipeline/keypoint_inbox.h"
#include "daemon/pipeline/pacer.h"
#include "daemon/service/change_log.h"
#include "daemon/service/clock_watch.h"
#include "daemon/service/diagnostic_log.h"
#include "daemon/service/disk_watch.h"
#include "daemon/service/furniture_looks.h"
#include "daemon/service/service_control.h"
#include "daemon/service/service_log.h"
#include "daemon/service/service_manager.h"
#include "daemon/status/light_watch.h"
#include "daemon/status/service_report.h"
#include "daemon/status/status_window.h"

namespace mocap {

/// Where the main thread reports to, and what it queries. Borrowed.
struct WatchParts {
  ServiceControl& control;
  ServiceManager& manager;
  const ChannelWatch& channels;
  const ServiceLog& log;
  const FurnitureLooks& furniture;
  const KeypointInbox& keypoints;
  NodeListener* nodes;            ///< At a studio; otherwise null.
  SilhouetteSender* silhouettes;  ///< At a node; otherwise null.
  StudioListener* studio;         ///< Likewise.
};

/// Checks the running daemon some times a second and reports on it. Never waits for a disk.
class Watch {
 public:
  Watch(const ServiceParts& parts, const WatchParts& around, ServiceReport about);

  void Tick();
  /// Reloads the configuration in its own thread.
  void Reload();
  /// Logs the final summary.
  void Conclude();

 private:
  void Report(const PipelineStatus& status);
  void LookAtClock();
  void LookAtStudio(const PipelineStatus& status);
  void LookAtDisk();
  void LookAtDelivery();
  void ClearLine() const;

  const ServiceParts parts_;
  const WatchParts around_;
  ServiceReport report_;
  const std::int64_t start_ns_;
  std::int64_t found_ns_;  ///< When somebody was last tracked; before the first set, now.
  const bool on_terminal_ = isatty(STDOUT_FILENO) == 1;
  ProgressWatch progress_;
  ChangeLog log_;
  DiagnosticLog complaints_;
  std::vector<std::string> told_;  ///< Diagnostics of the last report.
  StatusWindow window_;
  LightWatch light_;
  ClockWatch clock_;
  Pacer status_pacer_;
  Pacer metrics_pacer_;
  DiskWatch disk_;
  std::future<void> reload_;
};

}  // namespace mocap
