#include "core/tracking/tracker.h"

namespace mocap {
namespace {

using JacobianBlock = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDof>;

constexpr int kIterations = 5;
constexpr double kPointStdMm = 40;
constexpr double kStartStdMm = 50;
constexpr double kStartStdRad = 0.3;

}  // namespace

Tracker::Tracker(const BodyModel& body, const PoseState& pose)
    : body_(body), filter_(MotionNoise{}), surface_fit_(SurfaceFitOptions{}) {
  filter_.Reset(pose, kStartStdMm, kStartStdRad);
}

void Tracker::Update(const Evidence& evidence, double dt_s) {
  if (dt_s > 0) filter_.Predict(dt_s);
  surface_fit_.SetEvidence(evidence);
  if (body_.table().measurement == Measurement::kPoints) {
    FollowPoints(evidence.cloud);
  } else {
    FollowSurface(evidence);
  }
  quality_ = surface_fit_.QualityAt(body_, filter_.pose());
}

void Tracker::FollowPoints(const VoxelCloud& cloud) {
  const LabeledVoxels& labeled = labeler_.Label(cloud, body_, filter_.pose());
  JacobianBlock J(3, body_.dof());
  filter_.Update(
      body_.table(),
      [&](const PoseState& pose, UpdateEquations& equations) {
        const Posture posture = body_.PostureAt(pose);
        const BodyPoints points_W = body_.PointsAt(posture);
        for (int i = 0; i < kPointCount; ++i) {
          if (!labeled.points_W[i]) continue;
          const Vector3 residual_mm = *labeled.points_W[i] - points_W.col(i);
          body_.PointJacobian(posture, body_.CarrierOf(static_cast<Point>(i)), points_W.col(i), J);
          equations.AddPoint(J, residual_mm, kPointStdMm * kPointStdMm);
        }
      },
      kIterations);
}

void Tracker::FollowSurface(const Evidence& evidence) {
  FitSurface();
  if (const auto recovered =
          limb_recovery_.Recover(body_, evidence, surface_fit_, filter_.pose())) {
    filter_.Jump(*recovered);
    FitSurface();
  }
}

void Tracker::FitSurface() {
  filter_.Update(
      body_.table(),
      [this](const PoseState& pose, UpdateEquations& equations) {
        surface_fit_.Linearize(body_, pose, equations);
      },
      kIterations);
}

}  // namespace mocap
