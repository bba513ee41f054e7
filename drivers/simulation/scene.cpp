#include "drivers/simulation/scene.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/errors.h"
#include "drivers/simulation/camera_rig.h"
#include "drivers/simulation/random.h"

namespace mocap::simulation {
namespace {

constexpr double kJitter_ns = 300'000;
constexpr double kMostMegapixels = 128;

const SimulatedStudioOptions& Checked(const SimulatedStudioOptions& options) {
  const auto refuse = [](const char* name, double found, const char* wanted) {
    std::ostringstream message;
    message << "simulated studio: " << name << " is " << found << "; wanted is " << wanted;
    throw SetupError(message.str());
  };
  if (!(options.stature_mm >= 1000 && options.stature_mm <= 2100))
    refuse("stature_mm", options.stature_mm, "1000 to 2100");
  if (!(options.fps >= 1 && options.fps <= 1000)) refuse("fps", options.fps, "1 to 1000");
  if (options.cameras < 1 || options.cameras > 64) refuse("cameras", options.cameras, "1 to 64");
  if (options.width_px < 16 || options.width_px > 8192)
    refuse("width_px", options.width_px, "16 to 8192");
  if (options.height_px < 16 || options.height_px > 8192)
    refuse("height_px", options.height_px, "16 to 8192");
  // Pictures of the empty studio are kept: some hundred bytes a pixel.
  const double megapixels = 1e-6 * options.cameras * options.width_px * options.height_px;
  if (megapixels > kMostMegapixels) {
    refuse("the size of all pictures together", megapixels, "at most 128 megapixels");
  }
  if (!(options.seconds >= 0 && options.seconds < 1e6))
    refuse("seconds", options.seconds, "0 to 1000000");
  return options;
}

// The middle of the trunk, kept where heads can follow it.
Vector3 TrunkAt(const Person& person, std::int64_t capture_ns) {
  const BonePoses bones = person.BonesAt(capture_ns);
  constexpr double kReach_mm = 2200;
  const Vector3 p = (bones[kPelvis].p + bones[kNeck].p) / 2;
  return {std::clamp(p.x(), -kReach_mm, kReach_mm), std::clamp(p.y(), -kReach_mm, kReach_mm),
          p.z()};
}

}  // namespace

Person::Person(const SimulatedStudioOptions& options)
    : body_(MakeAnthropometry(Checked(options).stature_mm, options.seed)),
      motion_(MakeMotion(options.motion, body_, options.seed)),
      start_ns_(options.start_ns) {}

BonePoses Person::BonesAt(std::int64_t capture_ns) const {
  return PlaceBones(body_, motion_->PoseAt(static_cast<double>(capture_ns - start_ns_) * 1e-9));
}

Scene::Scene(const SimulatedStudioOptions& options)
    : options_(options),
      person_(options),
      room_(options.seed, person_.motion().furniture()),
      outfit_(MakeOutfit(options.seed, room_.wall_color())),
      mesh_(BuildPersonMesh(person_.body(), outfit_, options.seed)),
      sensor_(options.seed),
      cameras_(HangCameras({options.cameras, options.width_px, options.height_px, options.pan_tilt,
                            options.seed})) {}

std::int64_t Scene::NominalTime(std::int64_t frame) const {
  // Since 1970 at 1000 Hz a frame's number has 41 bits; long double keeps the nanoseconds.
  const long double period_ns = 1e9L / static_cast<long double>(options_.fps);
  return options_.start_ns + std::llround(static_cast<long double>(frame) * period_ns);
}

std::int64_t Scene::CaptureTime(int camera, std::int64_t frame) const {
  Random random(Mix(options_.seed, Tag("jitter"), static_cast<std::uint64_t>(camera),
                    static_cast<std::uint64_t>(frame)));
  return NominalTime(frame) + std::llround(random.Uniform(-kJitter_ns, kJitter_ns));
}

PanTiltAngles Scene::AnglesAt(int camera, std::int64_t capture_ns) const {
  if (!cameras_[camera].head) return {};
  constexpr int kSamples = 5;
  constexpr std::int64_t kSpacing_ns = 80'000'000;
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < kSamples; ++i) sum += TrunkAt(person_, capture_ns - i * kSpacing_ns);
  return AimInSteps(cameras_[camera], sum / kSamples);
}

PanTiltLimits Scene::ReachOf(int camera) const {
  if (!cameras_[camera].head) return {};
  // Heads that are told where to turn begin at zero and come a little after, or before, the person.
  const double margin_rad = options_.follow ? 0.1 : 0.02;
  const PanTiltAngles start =
      options_.follow ? PanTiltAngles{} : AnglesAt(camera, options_.start_ns);
  PanTiltLimits reach{start, start};
  auto& [least, most] = reach;
  for (int i = 0; i < 400; ++i) {
    const PanTiltAngles a = AnglesAt(camera, options_.start_ns + i * 150'000'000LL);
    least = {std::min(least.pan_rad, a.pan_rad), std::min(least.tilt_rad, a.tilt_rad)};
    most = {std::max(most.pan_rad, a.pan_rad), std::max(most.tilt_rad, a.tilt_rad)};
  }
  return {{least.pan_rad - margin_rad, least.tilt_rad - margin_rad},
          {most.pan_rad + margin_rad, most.tilt_rad + margin_rad}};
}

std::vector<PanTiltAngles> Scene::Sweep(int camera, int frames) const {
  std::vector<PanTiltAngles> sweep(frames);
  if (!cameras_[camera].head) return sweep;
  const auto [least, most] = ReachOf(camera);
  const int rows = 4, columns = (frames + rows - 1) / rows;
  for (int i = 0; i < frames; ++i) {
    const int row = i / columns, along = i % columns;
    const double u = double(row % 2 == 0 ? along : columns - 1 - along) / std::max(1, columns - 1);
    const double v = double(row) / (rows - 1);
    sweep[i] = {least.pan_rad + u * (most.pan_rad - least.pan_rad),
                least.tilt_rad + v * (most.tilt_rad - least.tilt_rad)};
  }
  return sweep;
}

SceneView::SceneView(std::shared_ptr<const Scene> scene, int camera)
    : scene_(std::move(scene)), camera_(camera) {}

const EmptyViewRenderer& SceneView::Renderer() const {
  std::call_once(once_, [this] {
    renderer_ = std::make_unique<const EmptyViewRenderer>(calibration());
    if (!calibration().head) renderer_->Render(scene_->room(), calibration().X_CW, fixed_view_);
  });
  return *renderer_;
}

const EmptyView& SceneView::fixed_view() const {
  Renderer();
  return fixed_view_;
}

void SceneView::RenderView(const PanTiltAngles& angles, EmptyView& view) const {
  Renderer().Render(scene_->room(), calibration().PoseAt(angles), view);
}

std::vector<BackgroundFrame> SceneView::Background(int frames) const {
  const std::vector<PanTiltAngles> sweep = scene_->Sweep(camera_, frames);
  std::vector<BackgroundFrame> background(frames);
  EmptyView turned;
  for (int i = 0; i < frames; ++i) {
    const std::int64_t capture_ns = scene_->CaptureTime(camera_, i - 2 * frames);
    if (calibration().head) RenderView(sweep[i], turned);
    const EmptyView& view = calibration().head ? turned : fixed_view();
    scene_->sensor().Expose(view.image, LampGain(capture_ns),
                            Mix(scene_->options().seed, Tag("empty"),
                                static_cast<std::uint64_t>(camera_), static_cast<std::uint64_t>(i)),
                            background[i].image);
    background[i].angles = sweep[i];
  }
  return background;
}

ScenePainter::ScenePainter(std::shared_ptr<const SceneView> view)
    : view_(std::move(view)), person_(view_->calibration()) {}

void ScenePainter::Paint(std::int64_t capture_ns) {
  Paint(capture_ns, view_->scene().AnglesAt(view_->camera(), capture_ns));
}

void ScenePainter::Paint(std::int64_t capture_ns, const PanTiltAngles& angles) {
  const Scene& scene = view_->scene();
  const CameraCalibration& camera = view_->calibration();
  const PanTiltAngles before = angles_;
  angles_ = angles;
  const bool turned = camera.head && (fresh_ || angles_ != before);
  if (turned) view_->RenderView(angles_, turned_view_);
  const EmptyView& empty = camera.head ? turned_view_ : view_->fixed_view();
  person_.Draw(scene.mesh(), scene.outfit(), scene.person().BonesAt(capture_ns), empty,
               camera.PoseAt(angles_), !fresh_ && !turned, canvas_);
  scene.sensor().Expose(
      canvas_, LampGain(capture_ns),
      Mix(scene.options().seed, Tag("frame"), static_cast<std::uint64_t>(view_->camera()),
          static_cast<std::uint64_t>(capture_ns)),
      picture_);
  fresh_ = false;
}

}  // namespace mocap::simulation
