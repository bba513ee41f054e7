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
  filter_.Update(
      body_.table(),
      [this](const PoseState& pose, UpdateEquations& equations) {
        surface_fit_.Linearize(body_, pose, equations);
      },
      kIterations);
  quality_ = surface_fit_.QualityAt(body_, filter_.pose());
}

}  // namespace mocap
