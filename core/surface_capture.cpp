#include "core/surface_capture.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/acquisition/facing_watch.h"
#include "core/acquisition/model_acquirer.h"
#include "core/acquisition/size_refiner.h"
#include "core/counted_time.h"
#include "core/tracking/evidence.h"
#include "core/tracking/steady_pose.h"
#include "core/tracking/tracker.h"

namespace mocap {
namespace {

// A child of 1.1 m has about 18 litres of flesh. Less is a stray shadow, or somebody at the edge of
// the room.
constexpr double kLeastLitres = 12;
// Higher than the limit for a first fit: errors of cameras should not end tracking.
constexpr double kLostCostMm = 55;
// If a fit is worse than this for some frames, it is compared with a new search,
constexpr double kDoubtCostMm = 28;
// which must be better by this share of its cost.
constexpr double kClearGain = 0.15;
constexpr int kFramesToLose = 3;
// After each search without a better result, the wait doubles, up to this number of frames.
constexpr int kLongestDoubt = 48;
constexpr double kForgetAfterS = 1.0;
// The first search is a full one. Later ones, also for doubtful poses, are limited to about the
// available time.
constexpr double kSearchesPerS = 9;
constexpr double kLeastEffort = 0.1;
// Sizes settle after this many well-fitted frames.
constexpr int kFramesToRefine = 90;

double EffortWithin(double dt_s) { return std::clamp(kSearchesPerS * dt_s, kLeastEffort, 1.0); }

// Computes the covariance of a point of the body from that of the joints that move it.
Matrix3 CovarianceOf(const BodyModel& body, const Posture& posture, Point point,
                     const Vector3& p_WQ, const PoseCovariance& pose) {
  using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDof>;
  const int carrier = body.CarrierOf(point);
  Jacobian J(3, body.dof());
  body.PointJacobian(posture, carrier, p_WQ, J);
  std::array<int, kMaxDof> moving;
  int count = 0;
  while (count < kTorsoDof) moving[count] = count, ++count;
  for (int i = carrier; i >= 0; i = body.table().joints[i].parent) moving[count++] = kTorsoDof + i;
  Matrix3 covariance = Matrix3::Zero();
  for (int j = 0; j < count; ++j) {
    Vector3 sum = Vector3::Zero();
    for (int i = 0; i < count; ++i) sum += pose(moving[i], moving[j]) * J.col(moving[i]);
    covariance += sum * J.col(moving[j]).transpose();
  }
  return covariance;
}

}  // namespace

class SurfaceCapture::Impl {
 public:
  explicit Impl(const BodyTable& table) : acquirer_(table), nobody_(table, AverageSizes(1750)) {}

  const CaptureResult& Update(const Sighting& sighting, std::int64_t capture_ns,
                              UpdateObserver* observer) {
    // The clock may be set back.
    const std::int64_t passed_ns = last_ns_ ? std::max<std::int64_t>(0, capture_ns - *last_ns_) : 0;
    const double dt_s = static_cast<double>(passed_ns) * 1e-9;
    last_ns_ = capture_ns;
    evidence_.Gather(sighting);
    if (observer) observer->OnStageEnd(UpdateStage::kLabel);
    result_.body_changed = false;
    result_.voxels = evidence_.cloud.size();
    if (evidence_.cloud.volume_litres() < kLeastLitres) {
      NobodyThere(dt_s);
    } else {
      SomebodyThere(dt_s);
    }
    Report(dt_s);
    if (observer) observer->OnStageEnd(UpdateStage::kFilter);
    return result_;
  }

  void StartOver(const std::optional<BodySizes>& given) {
    given_ = given;
    GiveUp();
  }

  const CaptureResult& result() const { return result_; }
  PoseState PredictedPose(std::int64_t capture_ns) const {
    // If a person was lost before the sizes were known, only the last pose is left.
    if (!tracker_) return result_.pose;
    const std::int64_t ahead_ns = std::max<std::int64_t>(0, capture_ns - last_ns_.value());
    return tracker_->filter().PredictedPose(static_cast<double>(ahead_ns) * 1e-9);
  }
  const BodyModel& body() const { return tracker_ ? tracker_->body() : nobody_; }
  int acquisition_frames() const { return acquisition_frames_; }

 private:
  void NobodyThere(double dt_s) {
    if (result_.state == CaptureState::kTracking) Lose();
    if (result_.state == CaptureState::kLost) {
      Await(dt_s);
    } else {
      GiveUp();
    }
  }

  void Lose() {
    result_.state = CaptureState::kLost;
    lost_s_ = 0;
  }

  // A lost person is forgotten after a while.
  void Await(double dt_s) {
    lost_s_ += CountedS(dt_s);
    if (lost_s_ >= kForgetAfterS) GiveUp();
  }

  void GiveUp() {
    result_.state = CaptureState::kSearching;
    ForgetPerson();
  }

  void ForgetPerson() {
    tracker_.reset();
    opposite_.reset();
    known_ = given_;
    refiner_.reset();
    acquirer_.StartOver();
    looks_anew_ = true;
  }

  void SomebodyThere(double dt_s) {
    switch (result_.state) {
      case CaptureState::kSearching:
        Acquire(dt_s);
        break;
      case CaptureState::kLost:
        Acquire(dt_s);
        if (result_.state == CaptureState::kLost) Await(dt_s);
        break;
      case CaptureState::kAcquiring:
        ++frames_acquiring_;
        acquirer_.Refine(evidence_, dt_s);
        TakeAcquired();
        break;
      case CaptureState::kTracking:
        tracker_->Update(evidence_, dt_s);
        RefineSizes(*tracker_, *refiner_);
        facing_.Look(evidence_.cloud, tracker_->filter().pose(), dt_s);
        if (opposite_) {
          CompareFacings(dt_s);
        } else {
          LookAgainInDoubt(dt_s);
        }
        NoteSizes();
        NoticeLoss();
        break;
    }
  }

  void Acquire(double dt_s) {
    const double effort = std::exchange(looks_anew_, false) ? 1 : EffortWithin(dt_s);
    if (!acquirer_.Locate(evidence_, known_, {effort})) return;
    if (known_ && acquirer_.IsStranger(evidence_, effort)) return;
    looks_anew_ = true;
    frames_acquiring_ = 1;
    result_.state = CaptureState::kAcquiring;
    TakeAcquired();
  }

  void TakeAcquired() {
    tracker_ = acquirer_.best();
    facing_.StartOver();
    result_.body_changed = true;
    if (!acquirer_.settled()) return;
    result_.state = CaptureState::kTracking;
    opposite_.reset();
    if (!known_) {
      acquisition_frames_ = frames_acquiring_;
      duel_ = acquirer_.duel();
      if (const BodyHypothesis* opposite = acquirer_.opposite()) opposite_ = *opposite;
    }
    known_ = tracker_->body().sizes();
    if (!refiner_) refiner_ = acquirer_.sizes();
    bad_frames_ = 0;
  }

  void RefineSizes(Tracker& tracker, SizeRefiner& refiner) const {
    if (given_ || refiner.frames() >= kFramesToRefine) return;
    if (tracker.quality().Cost() > kDoubtCostMm) return;
    refiner.Add(tracker.body(), tracker.surface_fit(), tracker.filter().pose());
    tracker.Resize(refiner.Sizes());
  }

  void NoteSizes() {
    if (*known_ == tracker_->body().sizes()) return;
    known_ = tracker_->body().sizes();
    result_.body_changed = true;
  }

  // Follows the body that faces the opposite way, and goes over to it while it costs less.
  void CompareFacings(double dt_s) {
    Tracker& other = opposite_->tracker;
    other.Update(evidence_, dt_s);
    RefineSizes(other, opposite_->sizes);
    duel_.Add(CostMm(other) - CostMm(*tracker_), dt_s);
    if (duel_.second_leads()) {
      std::swap(*tracker_, other);
      std::swap(*refiner_, opposite_->sizes);
      duel_.Swap();
    }
    if (duel_.is_over()) opposite_.reset();
  }

  double PriorCostMm(const Tracker& tracker) const {
    return facing_.prior().CostMm(tracker.body(), tracker.filter().pose());
  }

  double CostMm(const Tracker& tracker) const {
    return tracker.quality().Cost() + PriorCostMm(tracker);
  }

  // Sizes from few frames may be the cause of a bad fit.
  bool SizesAreKnown() const { return given_ || refiner_->frames() >= kFramesToRefine; }

  // Neither unknown sizes nor the person's heading are taken for granted.
  void LookAgainInDoubt(double dt_s) {
    if (tracker_->quality().Cost() <= kDoubtCostMm && !facing_.is_backwards()) {
      doubtful_frames_ = 0;
      patience_ = kFramesToLose;
      return;
    }
    if (++doubtful_frames_ < patience_) return;
    doubtful_frames_ = 0;
    patience_ = std::min(2 * patience_, kLongestDoubt);
    const bool sizes_are_known = SizesAreKnown();
    const std::optional<BodySizes> sizes = sizes_are_known ? known_ : std::nullopt;
    const bool is_backwards = facing_.is_backwards();
    const std::optional<Vector3> walks_W = is_backwards ? facing_.walks_W() : std::nullopt;
    const SearchScope scope{EffortWithin(dt_s), tracker_->things()};
    if (!acquirer_.Locate(evidence_, sizes, scope, walks_W)) return;
    const Tracker& found = acquirer_.best();
    const bool same_way =
        found.filter().pose().X_WT.R.col(0).dot(tracker_->filter().pose().X_WT.R.col(0)) > 0;
    const bool may_turn = is_backwards && !same_way;
    if (sizes_are_known && !same_way && !may_turn) return;
    const double cost_mm = tracker_->quality().Cost();
    // Being less strained does not make up for a worse fit: arms overhead are strained.
    if (!may_turn && found.quality().Cost() >= cost_mm) return;
    const double wanted_mm = may_turn ? 0 : kClearGain * cost_mm;
    if (CostMm(found) > CostMm(*tracker_) - wanted_mm) return;
    tracker_ = found;
    facing_.StartOver();
    patience_ = kFramesToLose;
    if (sizes_are_known) return;
    known_ = found.body().sizes();
    refiner_ = acquirer_.sizes();
    result_.body_changed = true;
  }

  void NoticeLoss() {
    bad_frames_ = tracker_->quality().CostWithoutStray() > kLostCostMm ? bad_frames_ + 1 : 0;
    if (bad_frames_ < kFramesToLose && tracker_->filter().is_sound()) return;
    Lose();
    if (!SizesAreKnown()) ForgetPerson();
  }

  void Report(double dt_s) {
    if (!tracker_) return;
    const BodyModel& body = tracker_->body();
    const PoseFilter& filter = tracker_->filter();
    MeasureUncertainty(body, filter);
    if (result_.state != CaptureState::kTracking) steady_.Reset();
    result_.pose = steady_.Follow(body, filter, result_.point_std_mm, dt_s);
    result_.points_W = body.PointsAt(body.PostureAt(result_.pose));
    result_.residual_mm = tracker_->quality().surface_mm;
  }

  void MeasureUncertainty(const BodyModel& body, const PoseFilter& filter) {
    const Posture posture = body.PostureAt(filter.pose());
    const BodyPoints points_W = body.PointsAt(posture);
    for (int i = 0; i < kPointCount; ++i) {
      const Matrix3 covariance =
          CovarianceOf(body, posture, static_cast<Point>(i), points_W.col(i), filter.covariance());
      Eigen::SelfAdjointEigenSolver<Matrix3> axes;
      axes.computeDirect(covariance, Eigen::EigenvaluesOnly);
      result_.point_std_mm[i] = std::sqrt(std::max(0.0, axes.eigenvalues().maxCoeff()));
    }
  }

  ModelAcquirer acquirer_;
  FacingWatch facing_;
  BodyModel nobody_;
  Evidence evidence_;
  std::optional<Tracker> tracker_;
  SteadyPose steady_;
  std::optional<BodySizes> known_;
  std::optional<BodySizes> given_;  ///< Known before the person was seen.
  std::optional<SizeRefiner> refiner_;
  std::optional<BodyHypothesis> opposite_;  ///< Faces the opposite way, and may be right.
  FacingDuel duel_;                         ///< Of the tracker with that.
  std::optional<std::int64_t> last_ns_;
  CaptureResult result_;
  double lost_s_ = 0;       ///< Time since the person was lost.
  bool looks_anew_ = true;  ///< No search was made yet.
  int frames_acquiring_ = 0;
  int acquisition_frames_ = 0;
  int bad_frames_ = 0;
  int doubtful_frames_ = 0;
  int patience_ = kFramesToLose;  ///< Doubtful frames before the next search.
};

SurfaceCapture::SurfaceCapture(const BodyTable& table) : impl_(std::make_unique<Impl>(table)) {}
SurfaceCapture::~SurfaceCapture() = default;

const CaptureResult& SurfaceCapture::Update(const Sighting& sighting, std::int64_t capture_ns,
                                            UpdateObserver* observer) {
  return impl_->Update(sighting, capture_ns, observer);
}
void SurfaceCapture::Forget() { impl_->StartOver({}); }
void SurfaceCapture::Expect(const BodySizes& sizes) { impl_->StartOver(sizes); }
const CaptureResult& SurfaceCapture::result() const { return impl_->result(); }
PoseState SurfaceCapture::PredictedPose(std::int64_t capture_ns) const {
  return impl_->PredictedPose(capture_ns);
}
const BodyModel& SurfaceCapture::body() const { return impl_->body(); }
int SurfaceCapture::acquisition_frames() const { return impl_->acquisition_frames(); }

}  // namespace mocap
