#include "core/tracking/tracker.h"

namespace mocap {
namespace {

// Larger differences between motion and prediction are out of reach of the fit.
constexpr double kLeapMm = 50;
// A rival is replaced by another one that costs this much less.
constexpr double kBetterRivalMm = 0.5;
constexpr double kStartStdMm = 50;
constexpr double kStartStdRad = 0.3;

}  // namespace

Tracker::Tracker(const BodyModel& body, const PoseState& pose)
    : body_(body),
      filter_(MotionNoise{}),
      surface_fit_(SurfaceFitOptions{}),
      limb_recovery_(body.table()) {
  filter_.Reset(pose, kStartStdMm, kStartStdRad);
}

void Tracker::Update(const Evidence& evidence, double dt_s) {
  const Vector3 before_W = filter_.pose().X_WT.p;
  if (dt_s > 0) filter_.Predict(dt_s);
  surface_fit_.SetEvidence(evidence);
  FollowLeap(evidence.cloud, filter_.pose().X_WT.p - before_W);
  FollowSurface(evidence, dt_s);
  surface_fit_.Allow(quality_.things);
}

void Tracker::FollowLeap(const VoxelCloud& cloud, const Vector3& foreseen_W) {
  const Vector3 middle_W = cloud.Centroid();
  if (middle_W_) {
    const Vector3 unforeseen_W = middle_W - *middle_W_ - foreseen_W;
    PoseState leapt = filter_.pose();
    leapt.X_WT.p += unforeseen_W;
    if (unforeseen_W.norm() > kLeapMm && surface_fit_.QualityAt(body_, leapt).Cost() <
                                             surface_fit_.QualityAt(body_, filter_.pose()).Cost()) {
      filter_.Shift(unforeseen_W);
    }
  }
  middle_W_ = middle_W;
}

void Tracker::FollowSurface(const Evidence& evidence, double dt_s) {
  FitSurface();
  if (rival_) FollowRival(dt_s);
  if (const auto recovered =
          limb_recovery_.Recover(body_, evidence, surface_fit_, filter_.pose(), quality_, dt_s)) {
    filter_.Jump(*recovered);
    FitSurface();
    rival_.reset();
  } else if (const auto& found = limb_recovery_.rival();
             found && (!rival_ || found->cost_mm < rival_->cost_mm() - kBetterRivalMm)) {
    rival_.emplace(filter_, found->pose, found->cost_mm);
  }
}

void Tracker::FollowRival(double dt_s) {
  const RivalPose::Rank rank =
      rival_->Follow(body_, surface_fit_, filter_.pose(), quality_.Cost(), dt_s);
  if (rank == RivalPose::Rank::kUndecided) return;
  if (rank == RivalPose::Rank::kBetter) {
    filter_ = rival_->filter();
    quality_ = surface_fit_.QualityAt(body_, filter_.pose());
  }
  rival_.reset();
}

void Tracker::FitSurface() {
  filter_.Update(
      body_.table(),
      [this](const PoseState& pose, UpdateEquations& equations) {
        surface_fit_.Linearize(body_, pose, equations);
      },
      Iterations{});
  quality_ = surface_fit_.QualityAt(body_, filter_.pose());
}

}  // namespace mocap
