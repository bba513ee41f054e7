#include "core/solving/path_smoother.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/hypotheses/hypothesis_set.h"
#include "core/hypotheses/pose_deviations.h"
#include "core/solving/pose_smoother.h"
#include "core/solving/standing_feet.h"

namespace mocap {
namespace {

// Longer losses are not bridged: after this time, live tracking forgets somebody.
constexpr double kLongestBridge_s = 1;
// Where a path begins, it may be off as far as a hypothesis that was just found. Nothing is known
// less exactly.
struct Start {
  double std_mm = 50, std_rad = 0.3;
};
constexpr Start kStart{};
// Standard deviation of the place where a foot is held, as live.
constexpr double kStandStd_mm = 1;

using PointJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDof>;

// What a set says of the pose: the linearised evidence where the filter found the pose.
struct SetInformation {
  int set = 0;
  double dt_s = 0;   // Since the set before.
  double worth = 0;  // 0: bridged, there is no evidence.
  PoseState at = {};
  PoseCovariance information = {};
  PoseStep gradient = {};
  double probability = 0;
  double residual_mm = 0;
  int voxels = 0;

  bool is_bridged() const { return worth == 0; }
};

// A stretch of sets without a jump.
class Stretch {
 public:
  explicit Stretch(const BodyModel& body) : body_(body) {}
  void Clear() {
    sets_.clear();
    dt_s_.clear();
  }

  void Add(SetInformation set) { sets_.push_back(std::move(set)); }
  bool empty() const { return sets_.empty(); }
  // Forgets the bridged sets at the end: nothing shows where the motion led.
  void EndWithEvidence() {
    while (!sets_.empty() && sets_.back().is_bridged()) sets_.pop_back();
  }
  const std::vector<SetInformation>& sets() const { return sets_; }

  // Smooths the poses, once more with the feet where they stand.
  void Solve() {
    for (const SetInformation& set : sets_) dt_s_.push_back(set.dt_s);
    smoothed_ = SmoothAll({});
    std::vector<PoseState> poses;
    for (const SmoothedPose& smoothed : smoothed_) poses.push_back(smoothed.pose);
    standing_ = StandingFeetOf(body_, poses, dt_s_);
    smoothed_ = SmoothAll(standing_);
  }

  CaptureResult ResultOf(std::size_t i) const {
    const SetInformation& set = sets_[i];
    CaptureResult result;
    result.state = set.is_bridged() ? CaptureState::kBridged : CaptureState::kTracking;
    result.pose = smoothed_[i].pose;
    KeepWithinLimits(result.pose);
    result.residual_mm = set.residual_mm;
    result.voxels = set.voxels;
    if (!set.is_bridged()) result.probability = set.probability;
    result.contacts = standing_[i].contacts;
    const Posture posture = body_.PostureAt(result.pose);
    result.points_W = body_.PointsAt(posture);
    result.further_W = body_.FurtherPointsAt(posture);
    SetDeviations(body_, posture, CovarianceOf(i), result);
    AddBodyError(result);
    return result;
  }

 private:
  std::vector<SmoothedPose> SmoothAll(std::span<const Standing> standing) const {
    PoseFilter filter{MotionNoise{}};
    const PoseState first = sets_.front().at;
    filter.Reset(first, kStart.std_mm, kStart.std_rad);
    std::vector<MotionState> states;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
      if (i > 0) filter.Predict(sets_[i].dt_s);
      const PoseState from = sets_[i].is_bridged() ? filter.pose() : sets_[i].at;
      filter.UpdateFrom(
          from,
          [&](const PoseState& pose, UpdateEquations& equations) {
            AddEvidence(sets_[i], pose, equations);
            if (!standing.empty()) AddStands(standing[i], pose, equations);
          },
          Iterations{});
      states.push_back(filter.state());
    }
    return Smooth(states, dt_s_, MotionNoise{});
  }

  static void AddEvidence(const SetInformation& set, const PoseState& pose,
                          UpdateEquations& equations) {
    if (set.is_bridged()) return;
    const PoseStep gradient = set.gradient - set.information * pose.Minus(set.at);
    for (int j = 0; j < pose.dof(); ++j) {
      for (int i = 0; i <= j; ++i) equations.AddProduct(i, j, set.worth * set.information(i, j));
      equations.AddGradient(j, set.worth * gradient[j]);
    }
  }

  void AddStands(const Standing& standing, const PoseState& pose,
                 UpdateEquations& equations) const {
    const Posture posture = body_.PostureAt(pose);
    PointJacobian J(3, pose.dof());
    for (int i = 0; i < kContactCount; ++i) {
      if (!standing.places_W[i]) continue;
      const Point point = kContactPoints[i];
      const Vector3 foot_W = body_.PlaceOf(point, posture);
      body_.PointJacobian(posture, body_.CarrierOf(point), foot_W, J);
      equations.AddPoint(J, *standing.places_W[i] - foot_W, kStandStd_mm * kStandStd_mm);
    }
  }

  void KeepWithinLimits(PoseState& pose) const {
    const std::vector<JointAxis>& joints = body_.table().joints;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      double& angle = pose.theta[static_cast<Eigen::Index>(i)];
      angle = std::clamp(angle, joints[i].min_rad, joints[i].max_rad);
    }
  }

  // The errors of evidence last: smoothing makes the motion smooth, but no pose more certain than
  // its own set does.
  PoseCovariance CovarianceOf(std::size_t i) const {
    const SetInformation& set = sets_[i];
    if (set.is_bridged()) return smoothed_[i].covariance;
    PoseStep prior = PoseStep::Constant(set.at.dof(), 1 / (kStart.std_rad * kStart.std_rad));
    prior.head<3>().setConstant(1 / (kStart.std_mm * kStart.std_mm));
    PoseCovariance information = kFrameWorth * set.information;
    information.diagonal() += prior;
    const Eigen::Index n = information.rows();
    return Eigen::LLT<PoseCovariance>(information).solve(PoseCovariance::Identity(n, n));
  }

  const BodyModel& body_;
  std::vector<SetInformation> sets_;
  std::vector<double> dt_s_;
  std::vector<SmoothedPose> smoothed_;
  std::vector<Standing> standing_;
};

class PathSmoother {
 public:
  PathSmoother(RecordedSets& sets, const PathPart& part, Things things, PersonEvidence& evidence,
               const SolvedSink& sink)
      : sets_(sets), part_(part), things_(things), evidence_(evidence), sink_(sink) {}

  void Run() {
    for (std::size_t i = 0; i < part_.steps.size(); ++i) {
      const int set = part_.first + static_cast<int>(i);
      const PathStep& step = part_.steps[i];
      const double dt_s = i == 0 ? 0 : TimeBetween_s(sets_, set - 1, set);
      since_posed_s_ += dt_s;
      if (step.pose) {
        if (step.jumps || since_posed_s_ > kLongestBridge_s) Publish();
        SetInformation found = Measure(set, *step.pose, dt_s);
        found.probability = step.probability;
        stretch_.Add(std::move(found));
        since_posed_s_ = 0;
      } else if (!stretch_.empty()) {
        filter_.Predict(dt_s);
        stretch_.Add({.set = set, .dt_s = dt_s});
      }
    }
    Publish();
  }

 private:
  const BodyModel& body() const { return evidence_.track().body; }

  SetInformation Measure(int set, const PoseState& pose, double dt_s) {
    sets_.Read(set, recorded_);
    const Evidence& evidence = evidence_.In(recorded_, set, &pose);
    objective_.SetEvidence(evidence);
    SetInformation found{.set = set, .dt_s = dt_s, .voxels = evidence.cloud.size()};
    if (stretch_.empty()) {
      filter_.Reset(pose, kStart.std_mm, kStart.std_rad);
    } else {
      filter_.Predict(dt_s);
    }
    found.worth = FrameWorth(stretch_.empty() ? TimeToNext_s(set) : dt_s);
    filter_.UpdateFrom(
        pose,
        [&](const PoseState& at, UpdateEquations& equations) {
          objective_.Linearize(body(), at, things_, equations);
          found.at = at;
          found.information = equations.information();
          found.gradient = equations.gradient();
          equations.Weigh(found.worth);
        },
        Iterations{});
    found.residual_mm = objective_.At(body(), filter_.pose(), things_).surface_mm;
    return found;
  }

  double TimeToNext_s(int set) const {
    return set + 1 < sets_.count() ? TimeBetween_s(sets_, set, set + 1) : 1;
  }

  void Publish() {
    stretch_.EndWithEvidence();
    if (!stretch_.empty()) {
      stretch_.Solve();
      for (std::size_t i = 0; i < stretch_.sets().size(); ++i) {
        const int set = stretch_.sets()[i].set;
        if (set >= part_.begin && set < part_.end) sink_(set, stretch_.ResultOf(i));
      }
    }
    stretch_.Clear();
  }

  RecordedSets& sets_;
  const PathPart& part_;
  const Things things_;
  PersonEvidence& evidence_;
  const SolvedSink& sink_;
  PoseFilter filter_{MotionNoise{}};
  Objective objective_;
  RecordedSet recorded_;
  Stretch stretch_{body()};
  double since_posed_s_ = 0;
};

}  // namespace

void SmoothPath(RecordedSets& sets, const PathPart& part, Things things, PersonEvidence& evidence,
                const SolvedSink& sink) {
  PathSmoother(sets, part, things, evidence, sink).Run();
}

}  // namespace mocap
