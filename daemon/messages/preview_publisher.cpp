#include "daemon/messages/preview_publisher.h"

#include <algorithm>

#include "daemon/messages/reduced_picture.h"
#include "drivers/clock.h"
#include "drivers/go_behind.h"

namespace mocap {
namespace {

constexpr std::size_t kQueued = 1;
constexpr int kJpegQuality = 75;

/// All people's; without any, that of the person being measured.
void CopyBodies(const TrackedSet& set, std::vector<SeenBodies::Body>& bodies) {
  const bool is_measured = set.people.empty() && set.result.state != CaptureState::kSearching;
  bodies.resize(is_measured ? 1 : set.people.size());
  if (is_measured) {
    bodies.front().model = set.body;
    bodies.front().pose = set.result.pose;
    return;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].model = set.people[i].capture->body();
    bodies[i].pose = set.people[i].capture->result().pose;
  }
}

}  // namespace

PreviewPublisher::PreviewPublisher(LcmSender& sender, const LcmConfig& config,
                                   const std::vector<CameraCalibration>& cameras,
                                   CaptureTimes times)
    : sender_(sender),
      preview_channel_(config.prefix + "MOCAP_PREVIEW"),
      unknown_channel_(config.prefix + "MOCAP_UNKNOWN"),
      voxels_channel_(config.prefix + "MOCAP_VOXELS"),
      cameras_(cameras),
      times_(times),
      taps_(cameras.size()),
      thread_([this] { Run(); }) {}

PreviewPublisher::~PreviewPublisher() {
  stop_.store(true);
  bell_.Ring();
  thread_.join();
}

void PreviewPublisher::OnSet(const TrackedSet& set) {
  body_tap_.Offer([&](SeenBodies& copy) {
    if (!body_pacer_.IsDue(SteadyNs())) return false;
    copy.frame = set.frame;
    copy.capture_ns = set.capture_ns;
    CopyBodies(set, copy.bodies);
    copy.grid = set.grid;
    return true;
  });
}

void PreviewPublisher::Look(std::chrono::seconds duration) {
  const std::int64_t until_ns = SteadyNs() + std::chrono::nanoseconds(duration).count();
  std::int64_t before_ns = look_until_ns_.load();
  while (before_ns < until_ns && !look_until_ns_.compare_exchange_weak(before_ns, until_ns)) {
  }
  bell_.Ring();
}

void PreviewPublisher::Run() {
  // A start may be ended at once; busy processors would delay the end of an idle thread.
  bell_.WaitPast(0);
  GoBehind("preview");
  for (;;) {
    const int seen = bell_.count();
    if (stop_.load()) break;
    OpenOrClose();
    if (!is_open_ || !PublishWhatIsThere()) bell_.WaitPast(seen);
  }
  look_until_ns_.store(0);
  OpenOrClose();
}

// A viewer's leaving is noticed at the next picture.
void PreviewPublisher::OpenOrClose() {
  const bool is_wanted = SteadyNs() < look_until_ns_.load();
  if (is_wanted == is_open_) return;
  is_open_ = is_wanted;
  if (is_wanted) {
    for (std::size_t i = 0; i < taps_.size(); ++i) {
      const CameraCalibration& camera = cameras_[i];
      const Image<Bgr> picture(camera.width_px, camera.height_px);
      taps_[i].Open(kQueued, {.image = picture, .trimap = {}, .X_CW = {}}, bell_);
    }
    body_tap_.Open(kQueued, {}, bell_);
    return;
  }
  for (PreviewTap& tap : taps_) {
    tap.Close();
    tap.Free();
  }
  body_tap_.Close();
  body_tap_.Free();
}

bool PreviewPublisher::PublishWhatIsThere() {
  bool has_published = false;
  for (std::size_t i = 0; i < taps_.size(); ++i) {
    if (!taps_[i].queue().TryPop()) continue;
    Publish(i, taps_[i].queue().front());
    has_published = true;
  }
  if (body_tap_.queue().TryPop()) {
    Publish(body_tap_.queue().front());
    has_published = true;
  }
  return has_published;
}

std::int64_t PreviewPublisher::Utime(std::int64_t capture_ns) const {
  const bool is_present = times_ == CaptureTimes::kPresent;
  return (capture_ns + (is_present ? TheHostClock().OffsetNs() : 0)) / 1000;
}

void PreviewPublisher::Publish(std::size_t camera, const SeenFrame& seen) {
  preview_.utime = Utime(seen.capture_ns);
  preview_.camera = cameras_[camera].name;
  const Matrix3& R_CW = seen.X_CW.R;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) preview_.rotation[i][j] = R_CW(i, j);
    preview_.translation_mm[i] = seen.X_CW.p[i];
  }
  preview_.width_px = seen.image.width();
  preview_.height_px = seen.image.height();
  preview_.reduction = ReductionFor(seen.image.width(), kWidest_px);
  ReducePicture(seen.image.view(), preview_.reduction, reduced_);
  encoder_.Encode(reduced_.view(), kJpegQuality, preview_.jpeg);
  preview_.num_bytes = static_cast<std::int32_t>(preview_.jpeg.size());
  ReduceSilhouette(seen.trimap.person, preview_.reduction, preview_.run);
  preview_.num_runs = static_cast<std::int32_t>(preview_.run.size());
  PublishUnknown(seen.trimap.unknown);
  sender_.Send(preview_channel_, preview_, bytes_);
}

// Of the picture in preview_.
void PreviewPublisher::PublishUnknown(const Silhouette& unknown) {
  unknown_.utime = preview_.utime;
  unknown_.camera = preview_.camera;
  ReduceSilhouette(unknown, preview_.reduction, unknown_.run);
  unknown_.num_runs = static_cast<std::int32_t>(unknown_.run.size());
  sender_.Send(unknown_channel_, unknown_, bytes_);
}

void PreviewPublisher::Publish(const SeenBodies& seen) {
  std::vector<BodyInPlace> bodies;
  for (const SeenBodies::Body& body : seen.bodies) bodies.push_back({*body.model, body.pose});
  FillVoxels(seen.grid, Utime(seen.capture_ns) * 1000, seen.frame, bodies, voxels_);
  sender_.Send(voxels_channel_, voxels_, bytes_);
}

}  // namespace mocap
