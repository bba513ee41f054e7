#include "drivers/virtual_studio/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "core/errors.h"
#include "drivers/take/picture_coder.h"
#include "drivers/virtual_studio/motions/company.h"
#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/room/camera_rig.h"
#include "drivers/virtual_studio/room/room_plan.h"

namespace mocap::simulation {
namespace {

constexpr double kJitter_ns = 300'000;
constexpr double kMostMegapixels = 128;
constexpr double kLeastStature_mm = 1000, kMostStature_mm = 2100;

[[noreturn]] void Refuse(const char* name, double found, const std::string& wanted) {
  std::ostringstream message;
  message << "simulated studio: " << name << " is " << found << "; expected " << wanted;
  throw SetupError(message.str());
}

void CheckCoding(const SimulatedStudioOptions& options) {
  if (*options.crf < 0 || *options.crf > PictureCoder::kMostCrf)
    Refuse("crf", *options.crf, "0 to " + std::to_string(PictureCoder::kMostCrf));
  if (options.width_px % 2 != 0) Refuse("width_px", options.width_px, "an even number, with crf");
  if (options.height_px % 2 != 0)
    Refuse("height_px", options.height_px, "an even number, with crf");
  if (options.realtime || options.follow)
    Refuse("crf", *options.crf, "none in real time or with heads that follow");
}

void Check(const SimulatedStudioOptions& options) {
  if (!(options.stature_mm >= kLeastStature_mm && options.stature_mm <= kMostStature_mm))
    Refuse("stature_mm", options.stature_mm, "1000 to 2100");
  if (options.people < 1 || options.people > kMostSimulatedPeople)
    Refuse("people", options.people, "1 to " + std::to_string(kMostSimulatedPeople));
  if (!(options.fps >= 1 && options.fps <= 1000)) Refuse("fps", options.fps, "1 to 1000");
  if (options.cameras < 1 || options.cameras > 64) Refuse("cameras", options.cameras, "1 to 64");
  if (options.width_px < 16 || options.width_px > 8192)
    Refuse("width_px", options.width_px, "16 to 8192");
  if (options.height_px < 16 || options.height_px > 8192)
    Refuse("height_px", options.height_px, "16 to 8192");
  if (options.contrast != 0 && !(options.contrast >= 5 && options.contrast <= 100))
    Refuse("contrast", options.contrast, "5 to 100, or 0 for clothes of any colours");
  if (!(options.apart_s >= 0 && options.apart_s <= 0.5 / options.fps))
    Refuse("apart_s", options.apart_s, "0 to half a period");
  if (!(options.misled_share >= 0 && options.misled_share <= 1))
    Refuse("misled_share", options.misled_share, "0 to 1");
  if (options.crf) CheckCoding(options);
  // Pictures of the empty studio are kept: some hundred bytes per pixel.
  const double megapixels = 1e-6 * options.cameras * options.width_px * options.height_px;
  if (megapixels > kMostMegapixels) {
    Refuse("the size of all pictures together", megapixels, "at most 128 megapixels");
  }
  if (!(options.seconds >= 0 && options.seconds < 1e6))
    Refuse("seconds", options.seconds, "0 to 1000000");
  if (!(options.begin_s >= 0 && options.begin_s < 1e6))
    Refuse("begin_s", options.begin_s, "0 to 1000000");
}

// The middle of the trunk, limited to where heads can follow it.
Vector3 TrunkAt(const Person& person, std::int64_t capture_ns) {
  const BonePoses bones = person.BonesAt(capture_ns);
  constexpr double kReach_mm = 2200;
  const Vector3 p = (bones[kPelvis].p + bones[kNeck].p) / 2;
  return {std::clamp(p.x(), -kReach_mm, kReach_mm), std::clamp(p.y(), -kReach_mm, kReach_mm),
          p.z()};
}

// The first person is as in the options. The others are of the same age, with seeds of their own.
std::uint64_t SeedOf(const SimulatedStudioOptions& options, int person) {
  return person == 0 ? options.seed
                     : Mix(options.seed, Tag("person"), static_cast<std::uint64_t>(person));
}

double StatureOf(const SimulatedStudioOptions& options, int person) {
  if (person == 0) return options.stature_mm;
  Random random(Mix(SeedOf(options, person), Tag("stature")));
  return std::clamp(options.stature_mm * random.Uniform(0.92, 1.08), kLeastStature_mm,
                    kMostStature_mm);
}

std::vector<Block> FurnitureOf(const std::vector<Person>& people) {
  std::vector<Block> furniture;
  for (const Person& person : people)
    for (const Block& block : person.motion().furniture()) furniture.push_back(block);
  return furniture;
}

// Whether a camera is among those who draw the lowest lots.
bool IsMisled(const SimulatedStudioOptions& options, int camera) {
  const auto lot = [&options](int drawing) {
    return Mix(options.seed, Tag("misled"), static_cast<std::uint64_t>(drawing));
  };
  int before = 0;
  for (int other = 0; other < options.cameras; ++other) before += lot(other) < lot(camera);
  constexpr double kRounding = 1e-9;  // 14 % of 50 are 7, though their product is a little more.
  return before < std::ceil(options.misled_share * options.cameras - kRounding);
}

bool IsInPicture(const CameraCalibration& camera, const Vector3& p_C) {
  if (p_C.z() <= 0) return false;
  const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
  return pixel && pixel->x() >= 0 && pixel->y() >= 0 && pixel->x() <= camera.width_px - 1 &&
         pixel->y() <= camera.height_px - 1;
}

}  // namespace

BonePoses Person::BonesAt(std::int64_t capture_ns) const {
  return PlaceBones(body_, motion_->PoseAt(static_cast<double>(capture_ns - start_ns_) * 1e-9));
}

std::vector<Person> MakePeople(const SimulatedStudioOptions& options) {
  Check(options);
  std::vector<Anthropometry> bodies;
  for (int i = 0; i < options.people; ++i) {
    bodies.push_back(MakeAnthropometry(StatureOf(options, i), SeedOf(options, i)));
    if (options.varied) VaryBuild(SeedOf(options, i), bodies.back());
  }
  std::vector<std::unique_ptr<const Motion>> motions =
      MakeCompany(options.motion, bodies, options.seed);
  std::vector<Person> people;
  for (int i = 0; i < options.people; ++i)
    people.emplace_back(bodies[i], std::move(motions[i]),
                        options.start_ns - std::llround(options.begin_s * 1e9));
  return people;
}

Scene::Scene(const SimulatedStudioOptions& options)
    : options_(options),
      people_(MakePeople(options)),
      room_(options.seed, FurnitureOf(people_)),
      sensor_(options.seed),
      cameras_(HangCameras({.cameras = options.cameras,
                            .width_px = options.width_px,
                            .height_px = options.height_px,
                            .pan_tilt = options.pan_tilt,
                            .seed = options.seed,
                            .height_mm = options.camera_height_mm,
                            .arc_rad = options.camera_arc_rad})) {
  for (int i = 0; i < options.people; ++i) {
    const std::uint64_t seed = SeedOf(options, i);
    Outfit outfit = MakeOutfit(seed, room_.wall_color());
    outfit.costume =
        options.varied ? MakeCostume(seed, options.motion) : PlainCostume(options.motion);
    figures_.push_back({outfit, BuildPersonMesh(people_[i].body(), outfit, seed)});
  }
}

std::vector<BonePoses> Scene::BonesAt(std::int64_t capture_ns) const {
  std::vector<BonePoses> poses;
  for (const Person& person : people_) poses.push_back(person.BonesAt(capture_ns));
  return poses;
}

PersonPresence Scene::PresenceOf(int person, std::int64_t capture_ns) const {
  const PersonMesh& mesh = figures_[person].mesh;
  std::vector<Eigen::Vector3f> p_W, n_W;
  SkinMesh(mesh, people_[person].BonesAt(capture_ns), p_W, n_W);
  const auto is_inside = [&p_W](int v) { return p_W[v].x() > float(kDoorX_mm); };
  PersonPresence presence{.in_room = std::ranges::any_of(mesh.coarse_vertices, is_inside),
                          .whole = std::ranges::all_of(mesh.coarse_vertices, is_inside)};
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    const RigidTransform X_CW = cameras_[c].PoseAt(AnglesAt(static_cast<int>(c), capture_ns));
    presence.pictures += std::ranges::all_of(mesh.coarse_vertices, [&](int v) {
      return IsInPicture(cameras_[c], X_CW * p_W[v].cast<double>());
    });
  }
  return presence;
}

FigureStyle Scene::StyleOf(int camera) const {
  FigureStyle style{.contrast = options_.contrast, .soft_shadows = options_.soft_shadows};
  if (IsMisled(options_, camera)) {
    Random random(Mix(options_.seed, Tag("hidden"), static_cast<std::uint64_t>(camera)));
    style.hidden = random.Uniform(0, 1) < 0.5 ? HiddenClothes::kShirts : HiddenClothes::kTrousers;
  }
  return style;
}

std::int64_t Scene::NominalTime(std::int64_t frame) const {
  // Since 1970 at 1000 Hz, a frame number has 41 bits; long double keeps the nanoseconds.
  const long double period_ns = 1e9L / static_cast<long double>(options_.fps);
  return options_.start_ns + std::llround(static_cast<long double>(frame) * period_ns);
}

std::int64_t Scene::CaptureTime(int camera, std::int64_t frame) const {
  Random random(Mix(options_.seed, Tag("jitter"), static_cast<std::uint64_t>(camera),
                    static_cast<std::uint64_t>(frame)));
  // Multiples of the golden ratio are spread evenly, whatever the number of cameras.
  const double part = std::fmod(camera * std::numbers::phi, 1.0) - 0.5;
  const double late_ns = 1e9 * options_.apart_s * part;
  return NominalTime(frame) + std::llround(late_ns + random.Uniform(-kJitter_ns, kJitter_ns));
}

PanTiltAngles Scene::AnglesAt(int camera, std::int64_t capture_ns) const {
  if (!cameras_[camera].head) return {};
  constexpr int kSamples = 5;
  constexpr std::int64_t kSpacing_ns = 80'000'000;
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < kSamples; ++i) sum += TrunkAt(people_.front(), capture_ns - i * kSpacing_ns);
  return AimInSteps(cameras_[camera], sum / kSamples);
}

PanTiltLimits Scene::ReachOf(int camera) const {
  if (!cameras_[camera].head) return {};
  // Heads that follow commands start at zero and lag behind or lead the person a little.
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
    : view_(std::move(view)),
      renderer_(view_->calibration(), view_->scene().StyleOf(view_->camera())) {}

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
  renderer_.Draw(scene.figures(), scene.BonesAt(capture_ns), empty, camera.PoseAt(angles_),
                 !fresh_ && !turned, canvas_);
  scene.sensor().Expose(
      canvas_, LampGain(capture_ns),
      Mix(scene.options().seed, Tag("frame"), static_cast<std::uint64_t>(view_->camera()),
          static_cast<std::uint64_t>(capture_ns)),
      picture_);
  fresh_ = false;
}

}  // namespace mocap::simulation
