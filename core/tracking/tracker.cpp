#include "core/tracking/tracker.h"

namespace mocap {
namespace {

constexpr int kIterations = 5;
constexpr double kStartStdMm = 50;
constexpr double kStartStdRad = 0.3;

}  // namespace

Tracker::Tracker(const BodyModel& body, const PoseState& pose)
    : body_(body), filter_(MotionNoise{}), surface_fit_(SurfaceFitOptions{}) {
  filter_.Reset(pose, kStartStdMm, kStartStdRad);
}

void Tracker::Update(const VoxelCloud& cloud, double dt_s) {
  if (dt_s > 0) filter_.Predict(dt_s);
  surface_fit_.SetVoxels(cloud);
  Draw();
  if (const auto recovered = limb_recovery_.Recover(body_, cloud, filter_.pose())) {
    filter_.Jump(*recovered);
    Draw();
  }
  quality_ = surface_fit_.QualityAt(body_, filter_.pose());
}

void Tracker::Draw() {
  int iteration = 0;
  filter_.Update(
      body_.table(),
      [&](const PoseState& pose, UpdateEquations& equations) {
        const double widen = std::max(1.0, 4.0 - 1.0 * iteration++);
        surface_fit_.SetReach(150 * widen, 45 * widen);
        surface_fit_.Linearize(body_, pose, equations);
      },
      kIterations);
}

}  // namespace mocap
