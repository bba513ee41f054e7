#include "tools/view/live_feed.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/base/json.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/keypoint_message.h"
#include "daemon/messages/reduced_picture.h"
#include "daemon/messages/status_messages.h"
#include "drivers/clock.h"
#include "tools/page/picture_lines.h"
#include "tools/report/body_outline.h"
#include "tools/results/message_body.h"
#include "tools/results/pose_log.h"
#include "tools/view/camera_json.h"
#include "tools/view/status_json.h"
#include "tools/view/wire.h"

namespace mocap {
namespace {

/// A page that opens later would show an older pose as the present one.
constexpr std::int64_t kPoseHoldsNs = 250'000'000;
/// Of messages that come once or a few times per second.
constexpr std::int64_t kStatusHoldsNs = 2'500'000'000;
/// Pictures lag behind poses by at most this many poses.
constexpr std::size_t kPosesKept = 300;
/// A pose farther from a picture in time does not belong to it.
constexpr std::int64_t kSameMomentUs = 60'000;
constexpr int kLargestPreview_px = 2048;

LiveMessage Text(std::string json) {
  return {true, std::make_shared<const std::string>(std::move(json))};
}
LiveMessage Binary(std::string bytes) {
  return {false, std::make_shared<const std::string>(std::move(bytes))};
}

/// Adds how long a message tells of the present.
LiveMessage For(std::int64_t duration_ns, LiveMessage message) {
  message.until_ns = SteadyNs() + duration_ns;
  return message;
}

std::span<const std::uint8_t> BytesOf(const lcm::ReceiveBuffer& buffer) {
  return {static_cast<const std::uint8_t*>(buffer.data),
          static_cast<std::size_t>(buffer.data_size)};
}

template <typename Message>
std::optional<Message> Decoded(const lcm::ReceiveBuffer& buffer) {
  return DecodeMessage<Message>(BytesOf(buffer));
}

bool IsSound(const preview_t& preview) {
  const auto is_side = [](int px) { return px > 0 && px <= kLargestPicture_px; };
  return is_side(preview.width_px) && is_side(preview.height_px) && preview.reduction > 0 &&
         preview.width_px / preview.reduction <= kLargestPreview_px &&
         preview.height_px / preview.reduction <= kLargestPreview_px;
}

RigidTransform PoseOf(const preview_t& preview) {
  RigidTransform X_CW;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X_CW.R(i, j) = preview.rotation[i][j];
  }
  X_CW.p = Vector3(preview.translation_mm);
  return X_CW;
}

}  // namespace

LiveFeed::LiveFeed(lcm::LCM& lcm, const std::string& prefix, std::string url, Put put)
    : nobody_heard_(lcm, std::move(url), prefix), put_(std::move(put)), heard_ns_(SteadyNs()) {
  const std::string named = ChannelPattern(prefix);
  lcm.subscribe(named + kPoseChannel, &LiveFeed::OnPose, this);
  lcm.subscribe(named + kBodyChannel, &LiveFeed::OnBody, this);
  lcm.subscribe(named + kPeopleChannel, &LiveFeed::OnPeople, this);
  lcm.subscribe(named + kBodiesChannel, &LiveFeed::OnPersonBody, this);
  lcm.subscribe(named + kDetailsChannel, &LiveFeed::OnDetails, this);
  lcm.subscribe(named + "MOCAP_VOXELS", &LiveFeed::OnVoxels, this);
  lcm.subscribe(named + "MOCAP_STATUS", &LiveFeed::OnStatus, this);
  lcm.subscribe(named + kServiceChannel, &LiveFeed::OnService, this);
  lcm.subscribe(named + kContrastChannel, &LiveFeed::OnContrast, this);
  lcm.subscribe(named + kKeypointSendersChannel, &LiveFeed::OnKeypointSenders, this);
  lcm.subscribe(named + kKeypointsChannel, &LiveFeed::OnKeypoints, this);
  lcm.subscribe(named + "MOCAP_STUDIO", &LiveFeed::OnStudio, this);
  lcm.subscribe(named + "MOCAP_UNKNOWN", &LiveFeed::OnUnknown, this);
  lcm.subscribe(named + "MOCAP_PREVIEW", &LiveFeed::OnPreview, this);
  PutNotice();
}

void LiveFeed::NoteControl(const std::string& why) {
  control_ = why;
  PutNotice();
}

void LiveFeed::Tick() {
  const bool is_silent = SteadyNs() - heard_ns_ > Silence::kLimit_ns;
  silence_ = is_silent ? nobody_heard_.Text() : "";
  PutNotice();
}

void LiveFeed::PutNotice() {
  std::string notice = JsonText(
      {{"type", "notice"}, {"pictures", control_}, {"silence", silence_}, {"control", control_}});
  if (notice == notice_) return;
  notice_ = notice;
  put_(kNotice, Text(std::move(notice)));
}

// A daemon that tracks several people publishes all of them a moment later.
void LiveFeed::OnPose(const lcm::ReceiveBuffer* buffer, const std::string&) {
  std::optional<pose_t> pose = Decoded<pose_t>(*buffer);
  if (!pose) return;
  const bool people_follow = people_ns_ && SteadyNs() - *people_ns_ < Silence::kLimit_ns;
  if (!people_follow) PutPose(*pose);
  first_ = std::move(pose);
}

void LiveFeed::OnPeople(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const std::optional<people_t> set = Decoded<people_t>(*buffer);
  if (!set) return;
  people_ns_ = SteadyNs();
  std::vector<DrawnPose> poses = people_.Take(*set, details_);
  PutPeople();
  if (!poses.empty()) return PutPoses(std::move(poses));
  if (set->people.empty() && first_ && first_->utime == set->utime) PutPose(*first_);
}

void LiveFeed::PutPeople() {
  std::string people = people_.Json();
  if (people == told_people_) return;
  told_people_ = people;
  put_(kPeople, Text(std::move(people)));
}

void LiveFeed::PutPose(const pose_t& pose) {
  if (const std::optional<PoseRow> row = PoseRowOf(pose)) {
    PutPoses({DrawnPoseOf(pose, *row, body_ ? &*body_ : nullptr)});
  }
}

void LiveFeed::PutPoses(std::vector<DrawnPose> poses) {
  heard_ns_ = SteadyNs();
  std::string bytes;
  for (DrawnPose& pose : poses) {
    bytes += PoseBytes(pose);
    pose.capsules.clear();
  }
  put_(kPoses, For(kPoseHoldsNs, Binary(std::move(bytes))));
  const std::int64_t utime = poses.front().row.timestamp_ns / 1000;
  poses_.push_back(std::move(poses));
  if (poses_.size() > kPosesKept) poses_.pop_front();
  PutPicturesOf(utime);
}

void LiveFeed::OnBody(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const std::optional<body_t> body = Decoded<body_t>(*buffer);
  const std::optional<BodyRecord> record = body ? BodyRecordOf(*body) : std::nullopt;
  if (!record || (body_ && body_->IsOf(*record))) return;
  body_.emplace(*record);
  put_(kBody, Text(BodyJson(*record, body_->parts())));
}

void LiveFeed::OnPersonBody(const lcm::ReceiveBuffer* buffer, const std::string&) {
  if (const auto body = Decoded<person_body_t>(*buffer)) people_.TakeBody(*body);
}

void LiveFeed::OnDetails(const lcm::ReceiveBuffer* buffer, const std::string&) {
  details_.Add(BytesOf(*buffer));
}

void LiveFeed::OnVoxels(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const std::optional<voxels_t> voxels = Decoded<voxels_t>(*buffer);
  std::string bytes = voxels ? VoxelBytes(*voxels, 0) : std::string();
  if (!bytes.empty()) put_(kVoxels, For(kPoseHoldsNs, Binary(std::move(bytes))));
}

void LiveFeed::OnStatus(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const std::optional<status_t> status = Decoded<status_t>(*buffer);
  if (!status) return;
  heard_ns_ = SteadyNs();
  TakeStatus(*status, report_);
}

// The daemon sends it right after the status.
void LiveFeed::OnService(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const std::optional<service_t> service = Decoded<service_t>(*buffer);
  if (!service) return;
  TakeService(*service, report_);
  put_(kStatus, For(kStatusHoldsNs, Text(StatusJson(report_))));
}

void LiveFeed::OnContrast(const lcm::ReceiveBuffer* buffer, const std::string&) {
  if (auto contrast = Decoded<contrast_t>(*buffer)) contrast_ = std::move(*contrast);
}

void LiveFeed::OnKeypointSenders(const lcm::ReceiveBuffer* buffer, const std::string&) {
  if (const auto senders = Decoded<keypoint_senders_t>(*buffer))
    TakeKeypointSenders(*senders, report_);
}

// Anyone may send them: those of a moment that is not shown would displace others.
void LiveFeed::OnKeypoints(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const std::optional<keypoints_t> message = Decoded<keypoints_t>(*buffer);
  if (!message || !IsSound(*message) || poses_.empty()) return;
  const std::int64_t shown_ns = poses_.back().front().row.timestamp_ns;
  if (std::abs(message->capture_ns - shown_ns) > kKeypointsShownNs) return;
  const auto found = std::ranges::find(cameras_, message->camera, &CameraCalibration::name);
  if (found == cameras_.end()) return;
  const auto camera = static_cast<std::size_t>(found - cameras_.begin());
  KeypointView view = UsableOf(*message, *found).view;
  if (view.points.empty()) return;
  view.sender = message->sender;
  ShownKeypoints& shown = keypoints_[camera];
  shown.Add(std::move(view));
  put_(kKeypoints + camera, For(kKeypointsShownNs, Binary(shown.Bytes(static_cast<int>(camera)))));
}

void LiveFeed::OnStudio(const lcm::ReceiveBuffer* buffer, const std::string&) {
  std::optional<studio_t> studio = Decoded<studio_t>(*buffer);
  if (!studio || (studio->calibration == studio_.calibration && studio->name == studio_.name)) {
    return;
  }
  try {
    std::vector<CameraCalibration> cameras =
        ParseCalibration(studio->calibration, "the calibration in MOCAP_STUDIO");
    if (cameras.size() > kMaxCameras) return;
    cameras_ = std::move(cameras);
  } catch (const SetupError&) {
    // The sender is not a mocapd of this version. The page keeps what it has.
    return;
  }
  studio_ = std::move(*studio);
  waiting_.clear();
  unknown_.clear();
  keypoints_.clear();
  X_CW_.clear();
  for (const CameraCalibration& camera : cameras_) X_CW_.push_back(camera.X_CW);
  PutStudio();
}

void LiveFeed::PutStudio() { put_(kStudio, Text(StudioJson(studio_.name, cameras_, X_CW_))); }

/// The poses nearest to a time, if near enough.
const std::vector<DrawnPose>* LiveFeed::PosesAt(std::int64_t utime) const {
  const std::vector<DrawnPose>* nearest = nullptr;
  std::int64_t least_us = kSameMomentUs;
  for (const std::vector<DrawnPose>& poses : poses_) {
    const std::int64_t apart_us = std::abs(poses.front().row.timestamp_ns / 1000 - utime);
    if (apart_us > least_us) continue;
    least_us = apart_us;
    nearest = &poses;
  }
  return nearest;
}

const DrawnBody* LiveFeed::BodyOf(const DrawnPose& pose) const {
  if (pose.id == 0) return body_ ? &*body_ : nullptr;
  const LivePeople::Person* person = people_.Find(pose.id);
  return person && person->body ? &*person->body : nullptr;
}

void LiveFeed::MoveCamera(std::size_t camera, const preview_t& preview) {
  const RigidTransform X_CW = PoseOf(preview);
  const bool has_moved = cameras_[camera].head && X_CW.R.allFinite() && X_CW.p.allFinite() &&
                         !(X_CW.R == X_CW_[camera].R && X_CW.p == X_CW_[camera].p);
  if (!has_moved) return;
  X_CW_[camera] = X_CW;
  PutStudio();
}

void LiveFeed::OnUnknown(const lcm::ReceiveBuffer* buffer, const std::string&) {
  std::optional<unknown_t> unknown = Decoded<unknown_t>(*buffer);
  const bool is_known_camera =
      unknown &&
      std::ranges::find(cameras_, unknown->camera, &CameraCalibration::name) != cameras_.end();
  if (is_known_camera) unknown_[unknown->camera] = std::move(*unknown);
}

void LiveFeed::OnPreview(const lcm::ReceiveBuffer* buffer, const std::string&) {
  std::optional<preview_t> preview = Decoded<preview_t>(*buffer);
  if (!preview || !IsSound(*preview)) return;
  const auto found = std::ranges::find(cameras_, preview->camera, &CameraCalibration::name);
  if (found == cameras_.end()) return;
  const auto camera = static_cast<std::size_t>(found - cameras_.begin());
  MoveCamera(camera, *preview);
  // A picture may arrive before its pose, if that comes at all.
  const bool has_pose =
      !poses_.empty() && poses_.back().front().row.timestamp_ns / 1000 >= preview->utime;
  if (const auto before = waiting_.find(camera); before != waiting_.end()) {
    PutPicture(camera, before->second);
    waiting_.erase(before);
  }
  SeenPicture picture{std::move(*preview), {}};
  unknown_t& unknown = unknown_[picture.preview.camera];
  if (unknown.utime == picture.preview.utime) std::swap(picture.unknown_run, unknown.run);
  if (has_pose) {
    PutPicture(camera, picture);
  } else {
    waiting_.emplace(camera, std::move(picture));
  }
}

void LiveFeed::PutPicturesOf(std::int64_t utime) {
  std::erase_if(waiting_, [&](const auto& waiting) {
    const bool is_due = waiting.second.preview.utime <= utime;
    if (is_due) PutPicture(waiting.first, waiting.second);
    return is_due;
  });
}

std::vector<DrawnOutlines> LiveFeed::OutlinesOf(const std::vector<DrawnPose>& poses,
                                                std::size_t camera) const {
  std::vector<DrawnOutlines> bodies;
  for (const DrawnPose& pose : poses) {
    const DrawnBody* body = BodyOf(pose);
    const bool is_drawn =
        pose.row.state == CaptureState::kTracking && body && AreSizes(body->record().sizes);
    if (!is_drawn) continue;
    bodies.push_back(
        {.person = poses.size() > 1 ? pose.person : DrawnOutlines::kAlone,
         .lines = PartOutlines(pose.row, body->record().sizes, cameras_[camera], X_CW_[camera])});
  }
  return bodies;
}

void LiveFeed::PutPicture(std::size_t camera, const SeenPicture& seen) {
  const preview_t& preview = seen.preview;
  const int factor = preview.reduction;
  const auto lines_of = [&](const std::vector<std::int32_t>& runs) {
    return SilhouetteLines(
        SilhouetteFromRuns(runs, preview.width_px / factor, preview.height_px / factor), factor);
  };
  DrawnPicture picture{.camera = static_cast<int>(camera),
                       .width_px = preview.width_px,
                       .height_px = preview.height_px,
                       .capture_ms = static_cast<double>(preview.utime) / 1000,
                       .silhouette = lines_of(preview.run),
                       .unknown = lines_of(seen.unknown_run),
                       .unknown_share = {},
                       .bodies = {},
                       .jpeg = preview.jpeg};
  const auto told = std::ranges::find(contrast_.camera, preview.camera) - contrast_.camera.begin();
  if (told < contrast_.num_cameras)
    picture.unknown_share = contrast_.unknown_share[static_cast<std::size_t>(told)];
  if (const std::vector<DrawnPose>* poses = PosesAt(preview.utime)) {
    picture.bodies = OutlinesOf(*poses, camera);
  }
  put_(kPictures + camera, For(kStatusHoldsNs, Binary(PictureBytes(picture))));
}

}  // namespace mocap
