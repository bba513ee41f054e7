#include "core/surface_capture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/counted_time.h"
#include "core/evidence/evidence.h"
#include "core/evidence/pose_history.h"
#include "core/evidence/recent_keypoints.h"
#include "core/hypotheses/hypothesis_set.h"
#include "core/hypotheses/pose_deviations.h"
#include "core/hypotheses/steady_pose.h"
#include "core/proposals/scheduler.h"
#include "core/proposals/stance_search.h"

namespace mocap {
namespace {

// When a person's state changes.
struct StateLimits {
  // Less is a stray shadow: a child of 1.1 m has about 18 litres of flesh.
  double least_litres = 12;
  int frames_to_lose = 3;     // Of a bad fit, one after the other.
  double forget_after_s = 1;  // Since somebody was lost.
  int frames_to_refine = 90;  // Sizes settle after this many well-fitted frames.
  // Sizes are known when the stature changes by less in a frame, §8.1, or after this many: the
  // lengths of somebody who crouches stay uncertain.
  double settled_mm = 3;
  int frames_to_settle = 6;
  // Odds of 1000 to 1 make somebody a stranger where one person is expected: sizes that are
  // measured in the same frame fit better than known ones.
  double stranger_nats = 6.9;
};
constexpr StateLimits kLimits{};
class SurfaceCapture : public MotionCapture {
 public:
  explicit SurfaceCapture(const BodyTable& table)
      : scheduler_(table), nobody_(table, AverageSizes(1750)) {}

  const CaptureResult& Update(const Observation& observation, std::int64_t capture_ns,
                              UpdateObserver* observer) override {
    // The clock may be set back.
    const std::int64_t passed_ns = last_ns_ ? std::max<std::int64_t>(0, capture_ns - *last_ns_) : 0;
    const double dt_s = static_cast<double>(passed_ns) * 1e-9;
    last_ns_ = capture_ns;
    Gather(observation, dt_s);
    WeighKeypoints();
    if (observer) observer->OnStageEnd(UpdateStage::kLabel);
    result_.body_changed = false;
    result_.voxels = evidence_.cloud.size();
    if (evidence_.cloud.volume_litres() < kLimits.least_litres) {
      NobodyThere(dt_s);
    } else {
      objective_.SetEvidence(evidence_);
      SomebodyThere(dt_s);
    }
    Report(dt_s);
    if (observer) observer->OnStageEnd(UpdateStage::kFilter);
    return result_;
  }

  void Forget() override { StartOver({}); }
  void Expect(const BodySizes& sizes) override { StartOver(sizes); }

  const CaptureResult& result() const override { return result_; }
  PoseState PredictedPose(std::int64_t capture_ns) const override {
    // If a person was lost before the sizes were known, only the last pose is left.
    if (hypotheses_.empty()) return result_.pose;
    const std::int64_t ahead_ns = std::max<std::int64_t>(0, capture_ns - last_ns_.value());
    return hypotheses_.best().filter.PredictedPose(static_cast<double>(ahead_ns) * 1e-9);
  }
  const BodyModel& body() const override {
    return hypotheses_.empty() ? nobody_ : hypotheses_.best().body;
  }
  int acquisition_frames() const override { return acquisition_frames_; }

 private:
  void Gather(const Observation& observation, double dt_s) {
    recent_keypoints_.Add(observation.keypoints, dt_s);
    evidence_.recent_keypoints.clear();
    if (hypotheses_.empty()) {
      evidence_.Gather(observation);
      return;
    }
    const PersonMotion motion{
        body(), [this, dt_s](double after_s) {
          if (after_s < -dt_s)
            if (const PoseState* const past = PoseBefore(-after_s)) return *past;
          return hypotheses_.best().filter.PredictedPose(std::max(0.0, dt_s + after_s));
        }};
    evidence_.Gather(observation, &motion);
    if (!evidence_.keypoints.empty()) evidence_.recent_keypoints = recent_keypoints_.AtSet(motion);
  }

  const PoseState* PoseBefore(double before_s) const {
    return history_.NearestTo(*last_ns_ - std::llround(before_s * 1e9));
  }

  void WeighKeypoints() {
    for (KeypointRays& view : evidence_.keypoints) {
      const std::int64_t seen_ns = *last_ns_ + std::llround(view.after_s * 1e9);
      const auto [last, is_first] = last_views_ns_.try_emplace(view.camera, seen_ns);
      const std::int64_t after_ns = std::max<std::int64_t>(0, seen_ns - last->second);
      view.worth = is_first ? 1 : WorthOfNextView(static_cast<double>(after_ns) * 1e-9);
      last->second = seen_ns;
    }
  }

  void StartOver(const std::optional<BodySizes>& given) {
    given_ = given;
    GiveUp();
  }

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
    sizes_of_lost_ = hypotheses_.best().sizes;
    lost_s_ = 0;
  }

  // A lost person is forgotten after a while.
  void Await(double dt_s) {
    lost_s_ += CountedS(dt_s);
    if (lost_s_ >= kLimits.forget_after_s) GiveUp();
  }

  void GiveUp() {
    result_.state = CaptureState::kSearching;
    hypotheses_.Clear();
    history_.Clear();
    recent_keypoints_.Clear();
    last_views_ns_.clear();
    scheduler_.StartOver();
    known_ = given_;
    sizes_of_lost_.reset();
    looks_anew_ = true;
  }

  void SomebodyThere(double dt_s) {
    if (result_.state == CaptureState::kAcquiring || result_.state == CaptureState::kTracking) {
      Follow(dt_s);
      return;
    }
    Search(dt_s);
    if (result_.state == CaptureState::kLost) Await(dt_s);
  }

  void Search(double dt_s) {
    const double effort = std::exchange(looks_anew_, false) ? 1 : EffortWithin(dt_s);
    std::vector<Hypothesis> found = scheduler_.FindAnybody(objective_, known_, {effort});
    if (found.empty() || !found.front().fitness.IsCredible()) return;
    if (known_ && IsStranger(found.front(), effort)) return;
    // Sizes that were not settled when the person was lost go on being measured.
    if (known_)
      for (Hypothesis& hypothesis : found) hypothesis.sizes = sizes_of_lost_;
    hypotheses_.Begin(std::move(found), evidence_.cloud.Centroid());
    scheduler_.BeginRounds();
    looks_anew_ = true;
    frames_acquiring_ = 1;
    result_.state = known_ ? CaptureState::kTracking : CaptureState::kAcquiring;
    result_.body_changed = true;
    bad_frames_ = 0;
  }

  // Whether a body of other sizes explains the evidence clearly better than the known one.
  bool IsStranger(const Hypothesis& known, double effort) {
    const std::vector<Hypothesis> strangers =
        scheduler_.FindAnybody(objective_, std::nullopt, {effort});
    if (strangers.empty()) return false;
    const double lead = known.fitness.Sum() - strangers.front().fitness.Sum();
    return kFrameWorth * lead > kLimits.stranger_nats;
  }

  void Follow(double dt_s) {
    const BodySizes before = body().sizes();
    hypotheses_.Follow(objective_, dt_s);
    scheduler_.Try(objective_, hypotheses_, SizesAreKnown(), dt_s);
    RefineSizes();
    if (result_.state == CaptureState::kAcquiring) {
      ++frames_acquiring_;
      const double change_mm = std::abs(body().sizes().Stature() - before.Stature());
      if (change_mm < kLimits.settled_mm || frames_acquiring_ >= kLimits.frames_to_settle) {
        result_.state = CaptureState::kTracking;
        acquisition_frames_ = frames_acquiring_;
      }
    }
    if (result_.state == CaptureState::kTracking) {
      known_ = body().sizes();
      NoticeLoss();
    }
    if (!hypotheses_.empty() && !(body().sizes() == before)) result_.body_changed = true;
  }

  void RefineSizes() {
    for (Hypothesis& hypothesis : hypotheses_.all()) {
      if (given_ || !hypothesis.sizes || hypothesis.sizes->frames() >= kLimits.frames_to_refine)
        continue;
      if (hypothesis.fitness.IsCredible()) hypothesis.RefineSizes(objective_);
    }
  }

  bool SizesAreKnown() const {
    const auto& sizes = hypotheses_.best().sizes;
    return given_ || !sizes || sizes->frames() >= kLimits.frames_to_refine;
  }

  void NoticeLoss() {
    const Hypothesis& best = hypotheses_.best();
    bad_frames_ = best.fitness.IsLost() ? bad_frames_ + 1 : 0;
    if (bad_frames_ < kLimits.frames_to_lose && best.filter.is_sound()) return;
    Lose();
    // Sizes from few frames may be the cause of a bad fit.
    if (!SizesAreKnown()) {
      hypotheses_.Clear();
      known_ = given_;
      sizes_of_lost_.reset();
    }
  }

  void Report(double dt_s) {
    result_.probability.reset();
    result_.rival.reset();
    result_.agreements.clear();
    result_.contacts = kUnknownContacts;
    if (hypotheses_.empty() || result_.state == CaptureState::kSearching) return;
    const BodyModel& body = hypotheses_.best().body;
    const PoseFilter& filter = hypotheses_.best().filter;
    history_.Add(*last_ns_, filter.pose());
    const Posture filtered = body.PostureAt(filter.pose());
    SetDeviations(body, filtered, filter.covariance() / kFrameWorth, result_);
    if (result_.state != CaptureState::kTracking) {
      steady_.Reset();
      feet_.Reset();
    }
    result_.contacts = feet_.Update(body, filtered, dt_s);
    result_.foot_motions = feet_.motions();
    result_.pose = steady_.Follow(body, filter, result_.point_std_mm, result_.contacts, dt_s);
    AddBodyError(result_);
    const Posture posture = body.PostureAt(result_.pose);
    result_.points_W = body.PointsAt(posture);
    result_.further_W = body.FurtherPointsAt(posture);
    result_.residual_mm = hypotheses_.best().fitness.surface_mm;
    if (result_.state != CaptureState::kLost) ReportDoubt();
    ReportAgreement();
  }

  void ReportAgreement() {
    if (evidence_.keypoints.empty()) return;
    PosedBody posed;
    posed.Set(body(), hypotheses_.best().filter.pose());
    for (const KeypointRays& view : evidence_.keypoints)
      result_.agreements.push_back({view.view, KeypointTerm::ProbabilityOfRight(view, posed)});
  }

  void ReportDoubt() {
    result_.probability = hypotheses_.ProbabilityOf(hypotheses_.best());
    if (const Hypothesis* const rival = hypotheses_.Rival()) {
      result_.rival = {hypotheses_.ProbabilityOf(*rival),
                       rival->body.PointsAt(rival->body.PostureAt(rival->filter.pose()))};
    }
  }

  Scheduler scheduler_;
  BodyModel nobody_;
  Evidence evidence_;
  Objective objective_;
  HypothesisSet hypotheses_;
  PoseHistory history_;
  RecentKeypoints recent_keypoints_;
  std::map<int, std::int64_t> last_views_ns_;  ///< By camera.
  FootContacts feet_;
  SteadyPose steady_;
  std::optional<BodySizes> known_;
  std::optional<BodySizes> given_;  ///< Known before the person was seen.
  std::optional<SizeRefiner> sizes_of_lost_;
  std::optional<std::int64_t> last_ns_;
  CaptureResult result_;
  double lost_s_ = 0;       ///< Time since the person was lost.
  bool looks_anew_ = true;  ///< No search was made yet.
  int frames_acquiring_ = 0;
  int acquisition_frames_ = 0;
  int bad_frames_ = 0;
};

}  // namespace

std::unique_ptr<MotionCapture> MakeSurfaceCapture(const BodyTable& table) {
  return std::make_unique<SurfaceCapture>(table);
}

}  // namespace mocap
