// The main thread's part while the pipeline runs: status, log, systemd, the line on the terminal.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <future>
#include <optional>
#include <string>

#include "daemon/messages/channel_watch.h"
#include "daemon/nodes/node_listener.h"
#include "daemon/nodes/silhouette_sender.h"
#include "daemon/pipeline/frame_progress.h"
#include "daemon/pipeline/pacer.h"
#include "daemon/service/change_log.h"
#include "daemon/service/clock_watch.h"
#include "daemon/service/diagnostic_log.h"
#include "daemon/service/disk_watch.h"
#include "daemon/service/service_control.h"
#include "daemon/service/service_log.h"
#include "daemon/service/service_manager.h"
#include "daemon/status/light_watch.h"
#include "daemon/status/service_report.h"
#include "daemon/status/status_window.h"

namespace mocap {

/// Whom the main thread tells, and whom it asks. Borrowed.
struct WatchParts {
  ServiceControl& control;
  ServiceManager& manager;
  const ChannelWatch& channels;
  const ServiceLog& log;
  NodeListener* nodes;            ///< Of a studio; else null.
  SilhouetteSender* silhouettes;  ///< Of a node; else null.
};

/// Looks at the running daemon some times a second and tells of it. Nothing here waits for a disk.
class Watch {
 public:
  Watch(const ServiceParts& parts, const WatchParts& around, ServiceReport about);

  void Tick();
  /// Has the configuration read again, in a thread of its own.
  void Reload();
  /// Says what has come of it all.
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
  const bool on_terminal_ = isatty(STDOUT_FILENO) == 1;
  ProgressWatch progress_;
  ChangeLog log_;
  DiagnosticLog complaints_;
  std::vector<std::string> told_;  ///< What was not good at the last report.
  StatusWindow window_;
  LightWatch light_;
  ClockWatch clock_;
  Pacer status_pacer_;
  Pacer metrics_pacer_;
  DiskWatch disk_;
  std::future<void> reload_;
};

}  // namespace mocap
