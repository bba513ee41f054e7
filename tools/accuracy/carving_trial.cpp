#include "tools/accuracy/carving_trial.h"

#include <fmt/core.h>

#include <deque>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/miss_rates.h"
#include "drivers/simulation/simulated_studio.h"

namespace mocap {
namespace {

constexpr double kVoxel_mm = 25;
// A step of a walk later, poses are others.
constexpr int kMoments = 3;
constexpr double kStep_s = 0.6;

// What every camera shows at one moment.
class TrueMoment {
 public:
  TrueMoment(int cameras, double begin_s)
      : studio_(OpenSimulatedStudio(Options(cameras, begin_s))) {
    for (StudioCamera& camera : studio_.cameras) {
      auto* const simulated = dynamic_cast<SimulatedCamera*>(camera.driver.get());
      MOCAP_CHECK(simulated);
      Frame frame;
      simulated->Start();
      MOCAP_CHECK(simulated->Grab(frame, {}) == GrabStatus::kFrame);
      silhouettes_.push_back(simulated->TrueSilhouette());
      tables_.emplace_back(camera.calibration);
      views_.push_back({&tables_.back(), &silhouettes_.back(), camera.calibration.X_CW});
    }
  }

  const std::vector<CarvingView>& views() const { return views_; }

 private:
  static SimulatedStudioOptions Options(int cameras, double begin_s) {
    SimulatedStudioOptions options;
    options.cameras = cameras;
    options.people = 3;
    options.seconds = 1 / options.fps;
    options.begin_s = begin_s;
    return options;
  }

  Studio studio_;
  std::deque<SensorPlaneTable> tables_;
  std::deque<Silhouette> silhouettes_;
  std::vector<CarvingView> views_;
};

}  // namespace

double ShareCarvedByOneMore(int cameras) {
  Carver carver({.voxel_mm = kVoxel_mm, .several_people = true});
  VoxelGrid hull;
  double sum = 0;
  for (int i = 0; i < kMoments; ++i) {
    const TrueMoment moment(cameras, i * kStep_s);
    carver.Carve(moment.views(), hull);
    const auto all = static_cast<double>(hull.Count());
    for (int left_out = 0; left_out < cameras; ++left_out) {
      std::vector<CarvingView> others = moment.views();
      others.erase(others.begin() + left_out);
      carver.Carve(others, hull);
      sum += 1 - all / static_cast<double>(hull.Count());
    }
  }
  return sum / (kMoments * cameras);
}

std::string CarvingLines() {
  std::string text =
      "\nOne more camera carves this share of the hull of true masks of three people:\n";
  for (const int others : {3, 5, 7, 11, 15, 23}) {
    text += fmt::format("{:>4} others {:>5.1f} %  as miss rates expect {:>5.1f} %\n", others,
                        100 * ShareCarvedByOneMore(others + 1), 100 * CarvedByOneMore(others));
  }
  return text;
}

}  // namespace mocap
