#include "drivers/simulation/simulated_studio.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "drivers/clock.h"
#include "drivers/head_follower.h"
#include "drivers/pan_tilt_camera.h"
#include "drivers/simulation/coded_frames.h"
#include "drivers/simulation/picture_ahead.h"
#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/scene.h"

namespace mocap {
namespace {

constexpr int kBackgroundFrames = 40;
/// A camera fails at the start of such a slot, for kLossNs.
constexpr std::int64_t kLossSlotNs = 5'000'000'000;
constexpr std::int64_t kLossNs = 2'000'000'000;
constexpr double kSlotsPerMinute = 12;

}  // namespace

SimulatedCamera::SimulatedCamera(std::shared_ptr<const simulation::SceneView> view,
                                 std::shared_ptr<SimulatedHead> head)
    : view_(std::move(view)),
      head_(std::move(head)),
      painter_(std::make_unique<simulation::ScenePainter>(view_)) {}
SimulatedCamera::~SimulatedCamera() = default;

void SimulatedCamera::Start() {
  const SimulatedStudioOptions& options = view_->scene().options();
  // Slow work is done before the first frame is due.
  if (!view_->calibration().head) view_->fixed_view();
  first_ = 0;
  if (options.realtime)
    first_ = static_cast<std::int64_t>(
        std::ceil(static_cast<double>(TimelineNs() - options.start_ns) * 1e-9 * options.fps));
  next_ = first_;
  if (options.realtime && !head_) ahead_ = std::make_unique<simulation::PictureAhead>(view_);
  if (options.crf) {
    coded_ = std::make_unique<simulation::CodedFrames>(options.width_px, options.height_px,
                                                       options.fps, *options.crf);
  }
  started_ = true;
  prepared_ = false;
}

// Returns whether there is a next frame.
bool SimulatedCamera::PrepareNext() {
  const simulation::Scene& scene = view_->scene();
  const SimulatedStudioOptions& options = scene.options();
  if (options.realtime) {
    // A late caller loses the frames in between, as with any camera.
    const auto now = static_cast<std::int64_t>(
        std::floor(static_cast<double>(TimelineNs() - options.start_ns) * 1e-9 * options.fps));
    next_ = std::max(next_, now);
  } else if (options.seconds > 0 && next_ >= std::llround(options.seconds * options.fps)) {
    return false;
  }
  due_ns_ = scene.CaptureTime(view_->camera(), next_);
  if (ahead_) {
    ahead_->Ask(due_ns_);
  } else {
    Paint();
  }
  prepared_ = true;
  return true;
}

void SimulatedCamera::Paint() {
  head_ ? painter_->Paint(due_ns_, head_->At(due_ns_)) : painter_->Paint(due_ns_);
}

bool SimulatedCamera::IsLost(std::int64_t time_ns) const {
  const SimulatedStudioOptions& options = view_->scene().options();
  if (options.losses_per_minute <= 0 || time_ns % kLossSlotNs >= kLossNs) return false;
  const auto slot = static_cast<std::uint64_t>(time_ns / kLossSlotNs);
  const auto camera = static_cast<std::uint64_t>(view_->camera());
  simulation::Random random(simulation::Mix(options.seed, simulation::Tag("loss"), camera, slot));
  return random.Uniform(0, kSlotsPerMinute) < options.losses_per_minute;
}

GrabStatus SimulatedCamera::Grab(Frame& frame, std::chrono::milliseconds timeout) {
  MOCAP_CHECK(started_);
  if (!coded_) return GrabPainted(frame, timeout);
  while (!coded_->Take(frame)) {
    if (coded_->is_finished()) return GrabStatus::kEnd;
    if (GrabPainted(frame, timeout) == GrabStatus::kFrame) {
      coded_->Add(frame, painter_->figures());
    } else {
      coded_->Finish();
    }
  }
  return GrabStatus::kFrame;
}

GrabStatus SimulatedCamera::GrabPainted(Frame& frame, std::chrono::milliseconds timeout) {
  if (view_->scene().options().realtime && IsLost(TimelineNs())) {
    prepared_ = false;
    return GrabStatus::kLost;
  }
  const std::int64_t patience_ns = std::chrono::nanoseconds(timeout).count();
  const std::int64_t until_ns = view_->scene().options().realtime ? TimelineNs() + patience_ns : 0;
  if (!prepared_ && !PrepareNext()) return GrabStatus::kEnd;
  if (view_->scene().options().realtime) {
    SleepUntil(std::min(due_ns_, until_ns));
    if (due_ns_ > until_ns) return GrabStatus::kTimeout;
  }
  if (ahead_ && !ahead_->Take(due_ns_, painter_)) Paint();
  prepared_ = false;
  frame.image = painter_->picture().view();
  frame.capture_ns = due_ns_;
  frame.sequence = static_cast<std::uint64_t>(next_ - first_);
  frame.angles = painter_->angles();
  if (head_) head_->Advance(due_ns_);
  ++next_;
  return GrabStatus::kFrame;
}

void SimulatedCamera::Stop() {
  ahead_.reset();
  started_ = false;
}

ImageView<const std::uint8_t> SimulatedCamera::TrueMask() {
  mask_ = coded_ ? coded_->figures() : painter_->figures();
  for (std::uint8_t& value : mask_.pixels()) value = value != 0 ? 255 : 0;
  return static_cast<const Image<std::uint8_t>&>(mask_).view();
}

Silhouette SimulatedCamera::TrueSilhouette() {
  const ImageView<const std::uint8_t> mask = TrueMask();
  Silhouette silhouette(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) != 0) silhouette.Set(x, y);
    }
  }
  return silhouette;
}

SimulatedStudio::SimulatedStudio(const SimulatedStudioOptions& options)
    : scene_(std::make_shared<const simulation::Scene>(options)) {
  for (int i = 0; i < options.cameras; ++i)
    views_.push_back(std::make_shared<const simulation::SceneView>(scene_, i));
}

const std::vector<CameraCalibration>& SimulatedStudio::cameras() const { return scene_->cameras(); }

std::unique_ptr<SimulatedCamera> SimulatedStudio::OpenCamera(int camera) const {
  return std::make_unique<SimulatedCamera>(views_[camera]);
}

std::unique_ptr<CameraDriver> SimulatedStudio::OpenFollowing(
    int camera, std::shared_ptr<const SubjectPosition> person) const {
  const PanTiltLimits reach = scene_->ReachOf(camera);
  const auto head = std::make_shared<SimulatedHead>(reach);
  return std::make_unique<PanTiltCamera>(
      std::make_unique<SimulatedCamera>(views_[camera], head), head,
      HeadFollower(scene_->cameras()[camera], reach, std::move(person)));
}

std::vector<BackgroundFrame> SimulatedStudio::Background(int camera) const {
  std::vector<BackgroundFrame> background = views_[camera]->Background(kBackgroundFrames);
  const SimulatedStudioOptions& options = scene_->options();
  if (options.crf) simulation::CodePictures(options.fps, *options.crf, background);
  return background;
}

std::int64_t SimulatedStudio::NominalTime(std::int64_t frame) const {
  return scene_->NominalTime(frame);
}

PersonPresence SimulatedStudio::PresenceOf(int person, std::int64_t capture_ns) const {
  return scene_->PresenceOf(person, capture_ns);
}

Studio OpenSimulatedStudio(const SimulatedStudioOptions& options) {
  const auto simulated = std::make_shared<const SimulatedStudio>(options);
  Studio studio;
  studio.name = "simulated " + options.motion;
  studio.fps_nominal = options.fps;
  if (options.follow) studio.person = std::make_shared<SubjectPosition>();
  for (int i = 0; i < options.cameras; ++i) {
    std::unique_ptr<CameraDriver> driver = simulated->OpenCamera(i);
    if (options.follow) driver = simulated->OpenFollowing(i, studio.person);
    studio.cameras.push_back({simulated->cameras()[i], std::move(driver),
                              [simulated, i] { return simulated->Background(i); }});
  }
  return studio;
}

}  // namespace mocap
