#include "daemon/status/status_fields.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <type_traits>

#include "daemon/status/diagnostics.h"

namespace mocap {
namespace {

/// A silhouette that agrees less shows something else than the other cameras do.
constexpr double kLeastTrust = 0.5;
/// Takes need some GB.
constexpr double kLeastFree_bytes = 5e9;

template <std::size_t N, typename Enum>
std::string_view NameIn(const std::array<std::string_view, N>& names, Enum value) {
  const auto number = static_cast<std::size_t>(value);
  return number < N ? names[number] : "unknown";
}

template <typename Value>
Json JsonOf(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return NameOf(value);
  } else {
    return value;
  }
}
Json JsonOf(const std::filesystem::path& path) { return path.string(); }
Json JsonOf(const std::optional<double>& share) { return share.value_or(-1); }

/// A member, or a member's member.
template <auto... Members, typename Of>
Json Get(const Of& of) {
  return JsonOf((of.*....*Members));
}
/// Whether an optional member has a value.
template <auto... Members, typename Of>
bool Has(const Of& of) {
  return (of.*....*Members).has_value();
}
/// A duration in seconds.
template <auto... Members, typename Of>
Json Seconds(const Of& of) {
  return static_cast<double>((of.*....*Members)) / 1e9;
}

// Cameras.

template <int axis>
Json ShiftPx(const ReportedCamera& camera) {
  return camera.health.shift_px[axis];
}
Json OffPx(const ReportedCamera& camera) { return camera.health.shift_px.norm(); }
Json IsUp(const ReportedCamera& camera) { return camera.state == CameraState::kStreaming; }
bool IsSure(const ReportedCamera& camera) { return IsCompared(camera); }

constexpr auto kHealth = &CameraStatus::health;
constexpr auto kUnknown = &CameraHealth::unknown_share;
constexpr auto kMisses = &CameraHealth::miss_rate;

constexpr StatusField<ReportedCamera> kCameraFields[] = {
    Field<ReportedCamera>("name", Get<&CameraStatus::name>, 0, {"camera", -16}),
    Field<ReportedCamera>("node", Get<&CameraStatus::node>),
    Field<ReportedCamera>("state", Get<&CameraStatus::state>, 0, {"state", -10}),
    Field<ReportedCamera>("", IsUp, 0, {}, {"camera_up", "1 while the camera streams."}),
    Field<ReportedCamera>("frames_per_second", Get<&ReportedCamera::frames_per_second>, 2,
                          {"fps", 9, 1}),
    Field<ReportedCamera>("frames", Get<&CameraStatus::frames>, 0,
                          Only(Shown::kInStatus, {"frames", 12}),
                          {"camera_frames_total", "Frames delivered."}),
    Field<ReportedCamera>("dropped", Get<&CameraStatus::dropped>, 0, {"dropped", 9},
                          {"camera_dropped_frames_total", "Frames lost on the way or dropped."}),
    Field<ReportedCamera>(
        "late", Get<&CameraStatus::late>, 0, {"late", 9},
        {"camera_late_frames_total", "Frames that arrived after their set was processed."}),
    Field<ReportedCamera>("torn", Get<&CameraStatus::torn>, 0, {"damaged", 9},
                          {"camera_torn_frames_total", "Damaged frames."}),
    Field<ReportedCamera>("compared_moments", Get<kHealth, &CameraHealth::moments>),
    Field<ReportedCamera>("trust", Get<kHealth, &CameraHealth::overlap>, 3, Percent("trust", 8),
                          {"camera_trust_ratio", "Overlap with the hull of the other cameras."},
                          IsSure, kLeastTrust),
    Field<ReportedCamera>("right_px", ShiftPx<0>, 2),
    Field<ReportedCamera>("down_px", ShiftPx<1>, 2),
    Field<ReportedCamera>("off_px", OffPx, 2, {"off px", 8, 1}, {}, IsSure, -kAnyNumber,
                          kMostShift_px),
    Field<ReportedCamera>("light", Get<&CameraStatus::light>, 3, Percent("light", 8),
                          {"camera_light_ratio", "Brightness relative to the learned background."}),
    Field<ReportedCamera>("nudged_px", Get<&CameraStatus::nudged_px>, 2),
    Field<ReportedCamera>(
        "unknown_share", Get<kHealth, kUnknown>, 3, Only(Shown::kInStatus, Percent("unknown", 9)),
        {"camera_unknown_ratio", "Share of unknown pixels where people are shown."},
        Has<kHealth, kUnknown>),
    Field<ReportedCamera>("miss_rate", Get<kHealth, kMisses>, 3,
                          Only(Shown::kInStatus, Percent("missed", 9)),
                          {"camera_miss_ratio", "Share of people called empty that others show."},
                          Has<kHealth, kMisses>),
    Field<ReportedCamera>("", Get<&ReportedCamera::is_used>, 0,
                          Only(Shown::kInWatch, {"in the last set"})),
};

// People.

template <int axis>
Json TorsoMm(const ReportedPerson& person) {
  return person.torso_W[axis];
}
Json Stature(const ReportedPerson& person) { return person.sizes.Stature(); }
Json FollowedText(const ReportedPerson& person) { return Duration(person.followed_ns); }
bool IsTracked(const ReportedPerson& person) { return person.state == CaptureState::kTracking; }

/// "3  anna (96 %)"; the certainty if the name was recognized by the sizes.
Json LabelText(const ReportedPerson& person) {
  std::string text = std::to_string(person.id);
  if (!person.name.empty()) text += "  " + person.name;
  if (!person.name.empty() && person.certainty < 1)
    text += fmt::format(" ({:.0f} %)", 100 * person.certainty);
  return text;
}
/// Its first coordinates in metres.
template <int count>
Json TorsoText(const ReportedPerson& person) {
  std::string text;
  for (int axis = 0; axis < count; ++axis)
    text += fmt::format("{}{:.2f}", axis > 0 ? " " : "", person.torso_W[axis] / 1000);
  return text;
}

constexpr StatusField<ReportedPerson> kPersonFields[] = {
    Field<ReportedPerson>("", LabelText, 0, {"person", -24}),
    Field<ReportedPerson>("id", Get<&FollowedPerson::id>),
    Field<ReportedPerson>("name", Get<&FollowedPerson::name>),
    Field<ReportedPerson>("name_certainty", Get<&FollowedPerson::certainty>, 3),
    Field<ReportedPerson>("state", Get<&FollowedPerson::state>, 0, {"state", -12}),
    Field<ReportedPerson>("x_mm", TorsoMm<0>, 1),
    Field<ReportedPerson>("y_mm", TorsoMm<1>, 1),
    Field<ReportedPerson>("z_mm", TorsoMm<2>, 1),
    Field<ReportedPerson>("", TorsoText<2>, 0, Only(Shown::kInStatus, {"x y m", 16})),
    Field<ReportedPerson>("", TorsoText<3>, 0, Only(Shown::kInWatch, {"torso x y z m", 22})),
    Field<ReportedPerson>("residual_mm", Get<&FollowedPerson::residual_mm>, 2, {"fit mm", 9}, {},
                          IsTracked),
    Field<ReportedPerson>("stature_mm", Stature, 1, Only(Shown::kInStatus, {"stature mm", 12})),
    Field<ReportedPerson>("seconds", Seconds<&ReportedPerson::followed_ns>, 1),
    Field<ReportedPerson>("", FollowedText, 0, Only(Shown::kInStatus, {"tracked for"})),
};

// Nodes.

double ClockAhead(const NodeReport& node) {
  return -static_cast<double>(node.clock_apart_ns) / 1e6;
}
Json ClockAheadMs(const NodeReport& node) { return ClockAhead(node); }
Json IsHeard(const NodeReport& node) { return !IsSilent(node); }
Json HeardText(const NodeReport& node) { return IsSilent(node) ? "silent" : "heard"; }
bool WasHeard(const NodeReport& node) { return node.was_heard; }

Json ClockText(const NodeReport& node) {
  if (!node.clock_agrees) return fmt::format("{:+.1f} ms", ClockAhead(node));
  if (node.has_this_clock) return "this one";
  if (!node.clock_is_kept) return "not kept";
  return (node.clock_keeper.empty() ? "kept" : node.clock_keeper) +
         fmt::format(" {:.1f} ms", node.clock_error_ms);
}

constexpr StatusField<NodeReport> kNodeFields[] = {
    Field<NodeReport>("name", Get<&NodeReport::name>, 0, {"node", -16}),
    Field<NodeReport>("heard", IsHeard),
    Field<NodeReport>("", HeardText, 0, {"state", -10}),
    Field<NodeReport>("", ClockText, 0, {"clock", 20}, {}, WasHeard),
    Field<NodeReport>("has_this_clock", Get<&NodeReport::has_this_clock>),
    Field<NodeReport>("clock_agrees", Get<&NodeReport::clock_agrees>),
    Field<NodeReport>("clock_ahead_ms", ClockAheadMs, 3),
    Field<NodeReport>("clock_keeper", Get<&NodeReport::clock_keeper>),
    Field<NodeReport>("clock_is_kept", Get<&NodeReport::clock_is_kept>),
    Field<NodeReport>("clock_error_ms", Get<&NodeReport::clock_error_ms>, 3),
    Field<NodeReport>("received", Get<&NodeReport::received>, 0, {"received", 12}),
    Field<NodeReport>("lost", Get<&NodeReport::lost>, 0, {"lost", 10}),
    Field<NodeReport>("lost_share", Get<&NodeReport::lost_share>, 5),
    Field<NodeReport>("transit_p50_ms", Get<&NodeReport::transit_p50_ms>, 3, {"way ms", 12, 2}),
    Field<NodeReport>("transit_p99_ms", Get<&NodeReport::transit_p99_ms>, 3),
    Field<NodeReport>("bytes_per_frame", Get<&NodeReport::bytes_per_frame>, 0,
                      {"KB a frame", 12, 1, 1e-3}),
    Field<NodeReport>("complaints", Get<&NodeReport::complaints>),
    Field<NodeReport>("version", Get<&NodeReport::version>, 0, {"version"}),
};

// Senders of keypoints.

Json RefusedInAll(const KeypointSender& sender) { return sender.RefusedInAll(); }
template <KeypointRefusal reason>
Json Refused(const KeypointSender& sender) {
  return sender.refused[static_cast<std::size_t>(reason)];
}

constexpr StatusField<KeypointSender> kKeypointFields[] = {
    Field<KeypointSender>("name", Get<&KeypointSender::name>, 0, {"keypoints of", -16}),
    Field<KeypointSender>("views_per_second", Get<&KeypointSender::views_per_second>, 2,
                          {"a second", 10, 1},
                          {"keypoint_views_per_second", "People in pictures, lately."}),
    Field<KeypointSender>("lag_ms", Get<&KeypointSender::lag_ms>, 1, {"lag ms", 10, 0},
                          {"keypoint_lag_seconds", "From capture to arrival.", "", 1e-3}),
    Field<KeypointSender>("taken", Get<&KeypointSender::taken>, 0, {"taken", 10},
                          {"keypoint_views_total", "Views taken."}),
    Field<KeypointSender>("", RefusedInAll, 0, {"refused", 10}),
    Field<KeypointSender>("refused_invalid", Refused<KeypointRefusal::kInvalid>, 0, {},
                          {"keypoint_refused_total", "Views refused.", "reason=\"invalid\""}),
    Field<KeypointSender>("refused_camera", Refused<KeypointRefusal::kCamera>, 0, {},
                          {"keypoint_refused_total", "", "reason=\"camera\""}),
    Field<KeypointSender>("refused_old", Refused<KeypointRefusal::kOld>, 0, {},
                          {"keypoint_refused_total", "", "reason=\"old\""}),
    Field<KeypointSender>("refused_ahead", Refused<KeypointRefusal::kAhead>, 0, {},
                          {"keypoint_refused_total", "", "reason=\"ahead\""}),
    Field<KeypointSender>("refused_empty", Refused<KeypointRefusal::kEmpty>, 0, {},
                          {"keypoint_refused_total", "", "reason=\"empty\""}),
    Field<KeypointSender>("refused_full", Refused<KeypointRefusal::kFull>, 0, {},
                          {"keypoint_refused_total", "", "reason=\"full\""}),
    Field<KeypointSender>("dropped_points", Get<&KeypointSender::dropped_points>),
    Field<KeypointSender>("agreement", Get<&KeypointSender::agreement>, 3, Percent("agrees", 10),
                          {"keypoint_agreement_ratio", "Agreement with the poses."},
                          Has<&KeypointSender::agreement>, kLeastAgreement),
};

// Parts of the service.

constexpr StatusField<StageTiming> kStageFields[] = {
    Field<StageTiming>("count", Get<&StageTiming::count>),
    Field<StageTiming>("p50_ms", Get<&StageTiming::p50_ms>, 3, {},
                       {"stage_seconds", "Recent duration of a stage; latency from capture.",
                        "quantile=\"0.5\"", 1e-3}),
    Field<StageTiming>("p99_ms", Get<&StageTiming::p99_ms>, 3, {},
                       {"stage_seconds", "", "quantile=\"0.99\"", 1e-3}),
    Field<StageTiming>("max_ms", Get<&StageTiming::max_ms>, 3),
};

constexpr StatusField<Made> kMadeFields[] = {
    Field<Made>("where", Get<&Made::where>),
    Field<Made>("made_s", Get<&Made::made_s>),
};

constexpr StatusField<RecordingStatus> kRecordingFields[] = {
    Field<RecordingStatus>("state", Get<&RecordingStatus::state>),
    Field<RecordingStatus>("folder", Get<&RecordingStatus::folder>),
    Field<RecordingStatus>("seconds", Seconds<&RecordingStatus::duration_ns>, 1),
    Field<RecordingStatus>("frames", Get<&RecordingStatus::frames>),
    Field<RecordingStatus>("waiting", Get<&RecordingStatus::waiting>),
    Field<RecordingStatus>("dropped", Get<&RecordingStatus::dropped>),
    Field<RecordingStatus>("problem", Get<&RecordingStatus::problem>),
};

constexpr StatusField<MovedFurniture> kMovedFields[] = {
    Field<MovedFurniture>("camera", Get<&MovedFurniture::camera>),
    Field<MovedFurniture>("place", Get<&MovedFurniture::place>),
    Field<MovedFurniture>("share", Get<&MovedFurniture::share>, 4),
    Field<MovedFurniture>("seconds", Seconds<&MovedFurniture::age_ns>),
};

// The service.

template <typename Of, std::size_t N>
std::span<const StatusField<Of>> All(const StatusField<Of> (&fields)[N]) {
  return fields;
}
template <auto fields, auto Member>
Json Whole(const ServiceReport& report) {
  return ObjectOf(All(*fields), report.*Member);
}
template <auto fields, auto... Members>
Json List(const ServiceReport& report) {
  return ObjectsOf(All(*fields), (report.*....*Members));
}
template <Stage stage>
Json Timing(const ServiceReport& report) {
  return ObjectOf(StageFields(), report.now.recent[stage]);
}
template <CaptureState state>
Json IsIn(const ServiceReport& report) {
  return report.now.status.state == state;
}
Json One(const ServiceReport&) { return 1; }
Json Complaints(const ServiceReport& report) { return Diagnostics(report); }
Json IsGood(const ServiceReport& report) { return Diagnostics(report).empty(); }
Json ComplaintCount(const ServiceReport& report) { return Diagnostics(report).size(); }
Json PeopleCount(const ServiceReport& report) { return report.people.size(); }
Json People(const ServiceReport& report) { return ObjectsOf(PersonFields(), PeopleOf(report)); }
Json Cameras(const ServiceReport& report) { return ObjectsOf(CameraFields(), CamerasOf(report)); }

constexpr auto kNow = &ServiceReport::now;
constexpr auto kStatus = &StatusReport::status;
constexpr auto kFit = &ServiceReport::fit;

constexpr StatusField<ServiceReport> kServiceFields[] = {
    Field<ServiceReport>("", One, 0, {},
                         {"build_info", "Version of the daemon.", "version=\"" MOCAP_VERSION "\""}),
    Field<ServiceReport>("version", Get<&ServiceReport::version>),
    Field<ServiceReport>("good", IsGood),
    Field<ServiceReport>("complaints", Complaints),
    Field<ServiceReport>("", ComplaintCount, 0, {},
                         {"complaints", "Number of current diagnostics."}),
    Field<ServiceReport>("studio", Get<&ServiceReport::studio>),
    Field<ServiceReport>("up_seconds", Seconds<&ServiceReport::up_ns>, 0, {},
                         {"up_seconds", "Time since the start."}),
    Field<ServiceReport>("fps_nominal", Get<&ServiceReport::fps_nominal>, 2),
    Field<ServiceReport>("lcm_url", Get<&ServiceReport::lcm_url>),
    Field<ServiceReport>("state", Get<kNow, kStatus, &PipelineStatus::state>),
    Field<ServiceReport>("", IsIn<CaptureState::kSearching>, 0, {},
                         {"state", "1 for the current state.", "state=\"searching\""}),
    Field<ServiceReport>("", IsIn<CaptureState::kAcquiring>, 0, {},
                         {"state", "", "state=\"acquiring\""}),
    Field<ServiceReport>("", IsIn<CaptureState::kTracking>, 0, {},
                         {"state", "", "state=\"tracking\""}),
    Field<ServiceReport>("", IsIn<CaptureState::kLost>, 0, {}, {"state", "", "state=\"lost\""}),
    Field<ServiceReport>("residual_mm", Get<kFit, &Fit::residual_mm>, 2, {},
                         {"residual_meters", "Mean distance of the fit.", "", 1e-3}),
    Field<ServiceReport>("voxels", Get<kFit, &Fit::voxels>),
    Field<ServiceReport>("people", People),
    Field<ServiceReport>("", PeopleCount, 0, {}, {"people", "Number of people tracked."}),
    Field<ServiceReport>("sets_per_second", Get<kNow, &StatusReport::sets_per_second>, 2),
    Field<ServiceReport>("sets_complete", Get<kNow, kStatus, &PipelineStatus::sets_complete>, 0, {},
                         {"sets_total", "Frame sets by outcome.", "outcome=\"complete\""}),
    Field<ServiceReport>("sets_partial", Get<kNow, kStatus, &PipelineStatus::sets_partial>, 0, {},
                         {"sets_total", "", "outcome=\"partial\""}),
    Field<ServiceReport>("sets_dropped", Get<kNow, kStatus, &PipelineStatus::sets_dropped>, 0, {},
                         {"sets_total", "", "outcome=\"dropped\""}),
    Field<ServiceReport>("spread", Timing<Stage::kSpread>),
    Field<ServiceReport>("latency", Timing<Stage::kLatency>),
    Field<ServiceReport>("segment", Timing<Stage::kSegment>),
    Field<ServiceReport>("carve", Timing<Stage::kCarve>),
    Field<ServiceReport>("label", Timing<Stage::kLabel>),
    Field<ServiceReport>("filter", Timing<Stage::kFilter>),
    Field<ServiceReport>("publish", Timing<Stage::kPublish>),
    Field<ServiceReport>("total", Timing<Stage::kTotal>),
    Field<ServiceReport>("cameras", Cameras),
    Field<ServiceReport>("node", Get<&ServiceReport::node>),
    Field<ServiceReport>("nodes", List<&kNodeFields, &ServiceReport::nodes, &NodesReport::nodes>),
    Field<ServiceReport>(
        "keypoints", List<&kKeypointFields, &ServiceReport::keypoints, &KeypointsReport::senders>),
    Field<ServiceReport>("keypoints_of_strangers",
                         Get<&ServiceReport::keypoints, &KeypointsReport::strangers>),
    Field<ServiceReport>("calibration", Whole<&kMadeFields, &ServiceReport::calibration>),
    Field<ServiceReport>("background", Whole<&kMadeFields, &ServiceReport::background>),
    Field<ServiceReport>("moved", List<&kMovedFields, &ServiceReport::moved>),
    Field<ServiceReport>("takes", Get<&ServiceReport::takes>),
    Field<ServiceReport>("bytes_free", Get<&ServiceReport::bytes_free>, 0, {},
                         {"free_bytes", "Free space on the disk for takes."}, nullptr,
                         kLeastFree_bytes),
    Field<ServiceReport>("recording", Whole<&kRecordingFields, &ServiceReport::recording>),
};

}  // namespace

std::vector<ReportedCamera> CamerasOf(const ServiceReport& report) {
  std::vector<ReportedCamera> cameras;
  for (const CameraStatus& camera : report.now.status.cameras)
    cameras.push_back({camera, report.now.frames_per_second[cameras.size()]});
  return cameras;
}

std::vector<ReportedPerson> PeopleOf(const ServiceReport& report) {
  std::vector<ReportedPerson> people;
  for (const FollowedPerson& person : report.people)
    people.push_back({person, report.people_ns - person.since_ns});
  return people;
}

std::span<const StatusField<ServiceReport>> ServiceFields() { return kServiceFields; }
std::span<const StatusField<ReportedCamera>> CameraFields() { return kCameraFields; }
std::span<const StatusField<ReportedPerson>> PersonFields() { return kPersonFields; }
std::span<const StatusField<NodeReport>> NodeFields() { return kNodeFields; }
std::span<const StatusField<KeypointSender>> KeypointFields() { return kKeypointFields; }
std::span<const StatusField<StageTiming>> StageFields() { return kStageFields; }

std::string_view NameOf(CaptureState state) { return NameIn(kCaptureStateNames, state); }
std::string_view NameOf(Stage stage) { return NameIn(kStageNames, stage); }
std::string_view NameOf(CameraState state) {
  constexpr std::array<std::string_view, 4> kNames = {"starting", "streaming", "lost", "ended"};
  return NameIn(kNames, state);
}
std::string_view NameOf(RecordingStatus::State state) {
  constexpr std::array<std::string_view, 4> kNames = {"none", "running", "complete", "failed"};
  return NameIn(kNames, state);
}

}  // namespace mocap
