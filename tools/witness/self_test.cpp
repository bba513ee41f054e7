#include "tools/witness/self_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "core/errors.h"
#include "drivers/virtual_studio/scene.h"
#include "drivers/virtual_studio/truth.h"

namespace mocap {
namespace {

constexpr std::array kKnownJoints = {Landmark::kShoulderL, Landmark::kShoulderR, Landmark::kElbowL,
                                     Landmark::kElbowR,    Landmark::kWristL,    Landmark::kWristR,
                                     Landmark::kHipL,      Landmark::kHipR,      Landmark::kKneeL,
                                     Landmark::kKneeR,     Landmark::kAnkleL,    Landmark::kAnkleR};

// As shares of the region's height.
constexpr double kShift = 16.0 / 256, kShiftTolerance = 3.0 / 256;
constexpr double kJointTolerance = 0.06;

/// Half of a person's width at the joints.
constexpr double kFlesh_mm = 100;

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Distances between points of the same landmarks [px].
std::vector<double> Apart(std::span<const Keypoint> found, std::span<const Keypoint> wanted) {
  std::vector<double> apart_px;
  for (const Keypoint& point : wanted) {
    const auto same = std::ranges::find(found, point.landmark, &Keypoint::landmark);
    if (same != found.end()) apart_px.push_back((same->px - point.px).norm());
  }
  return apart_px;
}

void RequireJoints(std::span<const Keypoint> found, const KnownPicture& known, double height_px,
                   const std::string& model) {
  const std::vector<double> apart_px = Apart(found, known.joints);
  if (apart_px.empty()) return;
  const double share = MedianOf(apart_px) / height_px;
  if (share > kJointTolerance)
    throw SetupError(fmt::format(
        "{}: joints that it finds in a picture of a person are {:.0f} % of the picture's height "
        "from the person's; expected at most {:.0f} %: OpenCV computes it wrong, or its "
        "description is wrong",
        model, 100 * share, 100 * kJointTolerance));
}

void RequireThatTheyMove(std::span<const Keypoint> found, std::span<const Keypoint> moved,
                         double height_px, const std::string& model) {
  const double share = MedianOf(Apart(moved, found)) / height_px;
  if (share > kShiftTolerance)
    throw SetupError(fmt::format(
        "{}: points that it finds move by {:.1f} % of the picture's height in the picture when it "
        "is cut out elsewhere; expected at most {:.1f} %: OpenCV computes it wrong, or its "
        "description is wrong",
        model, 100 * share, 100 * kShiftTolerance));
}

}  // namespace

KnownPicture PaintKnownPicture() {
  SimulatedStudioOptions options = RecordedSimulation();
  options.motion = "stand";
  const auto scene = std::make_shared<const simulation::Scene>(options);
  constexpr int kCamera = 0;
  const std::int64_t capture_ns = scene->CaptureTime(kCamera, 0);
  simulation::ScenePainter painter(std::make_shared<const simulation::SceneView>(scene, kCamera));
  painter.Paint(capture_ns);
  const CameraCalibration& camera = scene->cameras()[kCamera];
  const JointPositions truth_W = SimulatedTruth(options).At(capture_ns);
  KnownPicture known{.picture = painter.picture(), .box = {}, .joints = {}};
  std::vector<PosedCapsule> flesh;
  for (std::size_t i = 0; i < truth_W.size(); ++i) {
    flesh.emplace_back(truth_W[i], truth_W[i], kFlesh_mm, kFlesh_mm);
    const auto landmark = LandmarkNamed(kSimulatedJointNames[i]);
    if (!landmark || std::ranges::find(kKnownJoints, *landmark) == kKnownJoints.end()) continue;
    const auto px = PixelFromNormalized(camera.lens, (camera.X_CW * truth_W[i]).hnormalized());
    MOCAP_CHECK(px);
    known.joints.push_back({.landmark = *landmark, .px = px->cast<float>(), .score = 1});
  }
  known.box = SeeBody(flesh, camera, camera.X_CW)->box;
  return known;
}

void RequireGoodAnswers(PoseNetwork& network, const std::filesystem::path& model) {
  const KnownPicture known = PaintKnownPicture();
  const PictureRegion region = RegionAround(known.box, network.description().aspect());
  PictureRegion elsewhere = region;
  elsewhere.middle_px -= kShift * region.height_px * Vector2(1, 1);
  const std::vector<Keypoint> found = network.Find(known.picture.view(), region);
  const std::vector<Keypoint> moved = network.Find(known.picture.view(), elsewhere);
  if (found.empty() || moved.empty())
    throw SetupError(model.string() +
                     ": finds no points in a picture of a person, or numbers that are not finite");
  RequireJoints(found, known, region.height_px, model.string());
  RequireThatTheyMove(found, moved, region.height_px, model.string());
}

}  // namespace mocap
