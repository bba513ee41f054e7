// The tables of everything that mocapd knows of itself. A new field is a line of one of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/status/service_report.h"
#include "daemon/status/status_field.h"

namespace mocap {

/// A camera with what a report knows of it.
struct ReportedCamera : CameraStatus {
  double frames_per_second = 0;
  bool is_used = false;  ///< In the last set.
};

/// A person with what a report knows of them.
struct ReportedPerson : FollowedPerson {
  std::int64_t followed_ns = 0;
};

std::vector<ReportedCamera> CamerasOf(const ServiceReport& report);
std::vector<ReportedPerson> PeopleOf(const ServiceReport& report);

std::span<const StatusField<ServiceReport>> ServiceFields();
std::span<const StatusField<ReportedCamera>> CameraFields();
std::span<const StatusField<ReportedPerson>> PersonFields();
std::span<const StatusField<NodeReport>> NodeFields();
std::span<const StatusField<KeypointSender>> KeypointFields();
std::span<const StatusField<StageTiming>> StageFields();

/// Names of what a message tells as a number, which may be none of them.
std::string_view NameOf(CaptureState state);
std::string_view NameOf(CameraState state);
std::string_view NameOf(RecordingStatus::State state);
std::string_view NameOf(Stage stage);

}  // namespace mocap
