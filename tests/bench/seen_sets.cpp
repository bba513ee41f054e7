#include "tests/bench/seen_sets.h"

#include <algorithm>
#include <map>
#include <memory>

#include "core/reconstruction/silhouette/segmenter.h"
#include "drivers/simulation/simulated_studio.h"

namespace mocap::bench {
namespace {

constexpr int kRays = 100;

}  // namespace

const SeenSets& SeenSets::Get(int cameras) {
  static std::map<int, std::unique_ptr<SeenSets>> studios;
  auto& studio = studios[cameras];
  if (!studio) studio.reset(new SeenSets(cameras));
  return *studio;
}

SeenSets::SeenSets(int cameras) : sets_(kSets) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.cameras = cameras;
  options.fps = kFps;
  // A camera may miss some.
  options.seconds = 2 * kSets / kFps;
  const SimulatedStudio simulated(options);
  cameras_ = simulated.cameras();
  for (int c = 0; c < cameras; ++c) {
    const CameraCalibration& calibration = cameras_[static_cast<std::size_t>(c)];
    tables_.emplace_back(calibration);
    Segmenter segmenter(calibration, simulated.Background(c), {});
    const std::unique_ptr<SimulatedCamera> camera = simulated.OpenCamera(c);
    camera->Start();
    Frame frame;
    for (std::vector<Seen>& set : sets_) {
      while (camera->Grab(frame, std::chrono::milliseconds(1000)) != GrabStatus::kFrame) {
      }
      Seen& seen = set.emplace_back();
      segmenter.Segment(frame.image, {}, seen.trimap);
      seen.shading = segmenter.shading();
      TraceOutline(calibration, calibration.X_CW, seen.trimap, kRays, seen.outline);
    }
  }
}

int SeenSets::SetAt(int index) {
  constexpr int kPeriod = 2 * (kSets - 1);
  return std::min(index % kPeriod, kPeriod - index % kPeriod);
}

std::vector<CarvingView> SeenSets::Views(const std::vector<Seen>& set) const {
  std::vector<CarvingView> views;
  for (std::size_t c = 0; c < cameras_.size(); ++c)
    views.push_back({&tables_[c], &set[c].trimap.person, cameras_[c].X_CW, &set[c].trimap.unknown});
  return views;
}

std::vector<ShadedView> SeenSets::Shaded(std::vector<Seen>& set) const {
  std::vector<ShadedView> views;
  for (std::size_t c = 0; c < cameras_.size(); ++c)
    views.push_back(
        {static_cast<int>(c), &tables_[c], cameras_[c].X_CW, &set[c].shading, &set[c].trimap});
  return views;
}

std::vector<CameraEye> SeenSets::Eyes() const {
  std::vector<CameraEye> eyes;
  for (std::size_t c = 0; c < cameras_.size(); ++c) eyes.push_back({&tables_[c], cameras_[c].X_CW});
  return eyes;
}

}  // namespace mocap::bench
