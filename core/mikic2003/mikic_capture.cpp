#include "core/mikic2003/mikic_capture.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/errors.h"
#include "core/mikic2003/label_voxels.h"
#include "core/mikic2003/locate_body.h"
#include "core/mikic2003/orientation.h"
#include "core/mikic2003/part_widths.h"
#include "core/mikic2003/size_network.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap::mikic2003 {
namespace {

// §8.1: refinement stops when the sum of the changes of lengths falls below this.
constexpr double kSettledMm = 3;
// A child of 1.1 m has about 18 litres of flesh; less is nobody.
constexpr double kLeastLitres = 12;

}  // namespace

void RequirePaperAxes(const BodyTable& table) {
  std::array<bool, kPaperAngleCount> has{};
  for (const JointAxis& joint : table.joints) {
    if (joint.paper_angle > 0) has[joint.paper_angle - 1] = true;
  }
  const bool has_all = std::ranges::all_of(has, [](bool is_there) { return is_there; });
  if (has_all && table.joints.size() == has.size()) return;
  throw SetupError("body \"" + table.name + "\" has " + std::to_string(table.joints.size()) +
                   " axes; the tracker mikic2003 needs the 16 of the body \"mikic2003\"");
}

class MikicCapture::Impl {
 public:
  explicit Impl(const BodyTable& table) : body_(table, AverageSizes(1750)) {}

  const CaptureResult& Update(const Observation& observation, std::int64_t capture_ns,
                              UpdateObserver* observer) {
    // The clock may be set back.
    const std::int64_t passed_ns = last_ns_ ? std::max<std::int64_t>(0, capture_ns - *last_ns_) : 0;
    last_ns_ = capture_ns;
    const double dt_s = static_cast<double>(passed_ns) * 1e-9;
    result_.body_changed = false;
    cloud_.Build(observation.flesh, observation.room);
    result_.voxels = cloud_.size();
    const bool somebody = cloud_.volume_litres() >= kLeastLitres;
    if (!tracked_) {
      if (observer) observer->OnStageEnd(UpdateStage::kLabel);
      if (somebody) Acquire();
    } else {
      Follow(somebody, dt_s, observer);
    }
    if (tracked_) Report();
    if (observer) observer->OnStageEnd(UpdateStage::kFilter);
    return result_;
  }

  void StartOver(const std::optional<BodySizes>& given) {
    given_ = given;
    ForgetPerson();
  }

  const CaptureResult& result() const { return result_; }
  const BodyModel& body() const { return body_; }
  int acquisition_frames() const { return acquisition_frames_; }

 private:
  void ForgetPerson() {
    tracked_.reset();
    result_.state = CaptureState::kSearching;
  }

  // §7.1, and the first adjustment of Fig. 11 (j).
  void Acquire() {
    const std::optional<LocatedBody> located = LocateBody(cloud_);
    if (!located) return;
    body_.Resize(given_.value_or(located->sizes));
    tracked_.emplace(body_, located->R_WT, MeasurePoints(cloud_, located->frame));
    height_less_head_mm_ = located->height_less_head_mm;
    network_ = SizeNetwork();
    frames_acquiring_ = 1;
    bad_s_ = 0;
    result_.body_changed = true;
    result_.state = given_ ? CaptureState::kTracking : CaptureState::kAcquiring;
  }

  // Fig. 4, and Fig. 12 while sizes are refined.
  void Follow(bool somebody, double dt_s, UpdateObserver* observer) {
    tracked_->Predict(dt_s);
    const OrientedBody predicted = *tracked_;
    std::optional<LabeledTrunk> trunk;
    if (somebody) trunk = LabelTrunk(cloud_, body_, predicted.best().Pose(body_));
    if (observer && !trunk) observer->OnStageEnd(UpdateStage::kLabel);
    for (int pass = 0; trunk && pass < kPasses; ++pass) {
      const LabeledFrame labeled = LabelLimbs(cloud_, body_, *trunk, tracked_->best().Pose(body_));
      const MeasuredPoints points = MeasurePoints(cloud_, labeled);
      if (observer) observer->OnStageEnd(UpdateStage::kLabel);
      if (pass == 0 && result_.state == CaptureState::kAcquiring)
        RefineSizes(points, labeled.labels);
      *tracked_ = predicted;
      tracked_->Update(body_, points, result_.state != CaptureState::kAcquiring);
      if (observer) observer->OnStageEnd(UpdateStage::kFilter);
      // Labels of the other orientation would have its sides.
      if (!tracked_->is_decided()) break;
    }
    NoticeLoss(trunk.has_value(), dt_s);
    if (somebody && result_.state == CaptureState::kLost) LocateAgain();
  }

  void RefineSizes(const MeasuredPoints& points, const Labels& labels) {
    ++frames_acquiring_;
    BodySizes sizes = body_.sizes();
    MeasureLimbWidths(cloud_, labels, sizes);
    const double change_mm = network_.Update(MeasureLengths(points, height_less_head_mm_), sizes);
    body_.Resize(sizes);
    result_.body_changed = true;
    if (change_mm >= kSettledMm) return;
    result_.state = CaptureState::kTracking;
    acquisition_frames_ = frames_acquiring_;
  }

  void NoticeLoss(bool has_trunk, double dt_s) {
    const bool is_bad = !has_trunk || tracked_->residual_mm() > kLostResidualMm ||
                        !tracked_->best().Pose(body_).IsFinite();
    bad_s_ = is_bad ? bad_s_ + dt_s : 0;
    if (bad_s_ >= kForgottenAfterS) {
      ForgetPerson();
    } else if (result_.state != CaptureState::kAcquiring) {
      result_.state = is_bad ? CaptureState::kLost : CaptureState::kTracking;
    }
  }

  // §7.1, with the sizes that are known.
  void LocateAgain() {
    const std::optional<LocatedBody> located = LocateBody(cloud_);
    if (!located) return;
    tracked_.emplace(body_, located->R_WT, MeasurePoints(cloud_, located->frame));
  }

  void Report() {
    const PoseEkf& filter = tracked_->best();
    result_.pose = filter.Pose(body_);
    result_.points_W = body_.PointsAt(body_.PostureAt(result_.pose));
    result_.residual_mm = tracked_->residual_mm();
    for (int i = 0; i < kPointCount; ++i) {
      Eigen::SelfAdjointEigenSolver<Matrix3> axes;
      axes.computeDirect(filter.PointCovariance(body_, static_cast<Point>(i)),
                         Eigen::EigenvaluesOnly);
      result_.point_std_mm[i] = std::sqrt(std::max(0.0, axes.eigenvalues().maxCoeff()));
    }
  }

  BodyModel body_;
  VoxelCloud cloud_;
  std::optional<OrientedBody> tracked_;
  std::optional<BodySizes> given_;  ///< Known before the person was seen.
  SizeNetwork network_;
  double height_less_head_mm_ = 0;  ///< In the first frame.
  std::optional<std::int64_t> last_ns_;
  CaptureResult result_;
  int frames_acquiring_ = 0;
  int acquisition_frames_ = 0;
  double bad_s_ = 0;
};

MikicCapture::MikicCapture(const BodyTable& table) : impl_(std::make_unique<Impl>(table)) {}
MikicCapture::~MikicCapture() = default;

const CaptureResult& MikicCapture::Update(const Observation& observation, std::int64_t capture_ns,
                                          UpdateObserver* observer) {
  return impl_->Update(observation, capture_ns, observer);
}
void MikicCapture::Forget() { impl_->StartOver({}); }
void MikicCapture::Expect(const BodySizes& sizes) { impl_->StartOver(sizes); }
const CaptureResult& MikicCapture::result() const { return impl_->result(); }
// F is the identity: the prediction is the last pose.
PoseState MikicCapture::PredictedPose(std::int64_t) const { return impl_->result().pose; }
const BodyModel& MikicCapture::body() const { return impl_->body(); }
int MikicCapture::acquisition_frames() const { return impl_->acquisition_frames(); }

}  // namespace mocap::mikic2003
