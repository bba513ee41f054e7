// Handles requests to the running daemon.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>

#include "daemon/control/control_request.h"
#include "daemon/messages/pose_publisher.h"
#include "daemon/messages/preview_publisher.h"
#include "daemon/pipeline/pipeline.h"
#include "daemon/recording/recorder.h"
#include "daemon/service/background_learner.h"
#include "daemon/service/live_config.h"
#include "daemon/service/live_view.h"
#include "daemon/service/node_requests.h"
#include "daemon/service/occupied_learner.h"
#include "daemon/service/subjects.h"
#include "daemon/status/service_report.h"

namespace mocap {

/// The parts of the running daemon that requests use. Borrowed.
struct ServiceParts {
  LiveConfig& config;
  FramePath& path;
  Pipeline* pipeline;  ///< The path, if it tracks; null at a node.
  PosePublisher& publisher;
  PreviewPublisher& preview;
  LiveView& view;
  Recorder& recorder;
  BackgroundLearner& background;
  OccupiedLearner& occupied;
};

/// Answers requests. Thread-safe.
class ServiceControl {
 public:
  /// Time limit for a node that completes a take or learns a background.
  static constexpr std::chrono::seconds kNodePatience{50};

  /// People whose sizes are stored are recognized from now on.
  ServiceControl(const ServiceParts& parts, Subjects subjects);

  /// @throws SetupError for a wrong request, std::runtime_error for a failure.
  ControlReply Answer(const ControlRequest& request);
  /// Sets the report to give until the next one.
  void SetReport(const ServiceReport& report);
  /// Reads the configuration again. @throws SetupError
  std::string Reload();
  /// The configuration in force. Waits for no file.
  Config config();
  /// Whether a take is being recorded, here or at nodes.
  bool IsRecording() const;
  /// Completes that take everywhere, and logs what each computer has recorded.
  void EndRecording();

 private:
  std::string Do(const StatusRequest& request);
  std::string Do(const ReloadRequest&);
  std::string Do(const RecordStartRequest& request);
  std::string Do(const RecordStopRequest&);
  std::string Do(const RecordCancelRequest& request);
  std::string Do(const SubjectNewRequest&);
  std::string Do(const SubjectSaveRequest& request);
  std::string Do(const SubjectLoadRequest& request);
  std::string Do(const SubjectListRequest&);
  std::string Do(const BackgroundLearnRequest& request);
  std::string Do(const BackgroundOccupiedRequest& request);
  std::string Do(const BackgroundResultRequest&);
  std::string Do(const BackgroundStatusRequest&);
  std::string Do(const LookRequest&);

  Pipeline& Tracking() const;
  std::string StartRecording(const std::string& name);
  std::string StopRecording();
  std::string LearnBackground(bool anyway);
  void RequireNoRecording() const;
  void RequireNotLearning() const;

  const ServiceParts parts_;
  const Subjects subjects_;
  NodeRequests nodes_;
  std::atomic<bool> nodes_record_{false};  ///< They have begun a take and were not asked to stop.
  std::mutex report_mutex_;
  ServiceReport report_;
  std::int64_t report_ns_ = 0;  ///< When it was set, by the steady clock.
  std::mutex reload_mutex_;     ///< Held while a file is read.
  std::mutex config_mutex_;
  Config config_;
};

}  // namespace mocap
