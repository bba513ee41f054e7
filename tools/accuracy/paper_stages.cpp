#include "tools/accuracy/paper_stages.h"

#include "core/mikic2003/label_voxels.h"
#include "core/mikic2003/locate_body.h"
#include "core/mikic2003/measured_points.h"
#include "core/mikic2003/mikic_capture.h"

namespace mocap {
namespace {

using mikic2003::kForgottenAfterS;
using mikic2003::kLostResidualMm;
using mikic2003::kPasses;
using mikic2003::LabeledFrame;
using mikic2003::LabeledTrunk;
using mikic2003::OrientedBody;

// What truly belongs to the trunk, though its templates missed it, stays unlabelled.
LabeledFrame LabelTrueParts(const VoxelCloud& cloud, const LabeledTrunk& trunk,
                            const TrueParts& parts) {
  LabeledFrame frame{
      .labels = trunk.labels, .neck_W = trunk.neck_W, .upper_axes_W = parts.upper_axes_W()};
  for (const int voxel : mikic2003::VoxelsLabeled(trunk.labels, mikic2003::kUnlabeled)) {
    const BodyPart part = parts.PartAt(cloud.voxels()[voxel].center_W);
    const bool is_trunk = part == BodyPart::kHead || part == BodyPart::kTorso;
    if (!is_trunk) frame.labels[voxel] = mikic2003::LabelOf(part);
  }
  return frame;
}

}  // namespace

void PaperStages::Start(const BodyModel& body, const OrientedBody& first) {
  person_ = Person{body, first};
  is_bad_ = false;
  bad_s_ = 0;
}

void PaperStages::Follow(const VoxelGrid& flesh, double dt_s, const TrueParts* true_parts) {
  cloud_.Build(flesh);
  auto& [body, tracked] = *person_;
  tracked.Predict(dt_s);
  const OrientedBody predicted = tracked;
  const std::optional<LabeledTrunk> trunk =
      mikic2003::LabelTrunk(cloud_, body, predicted.best().Pose(body));
  for (int pass = 0; trunk && pass < kPasses; ++pass) {
    const LabeledFrame labeled = true_parts
                                     ? LabelTrueParts(cloud_, *trunk, *true_parts)
                                     : LabelLimbs(cloud_, body, *trunk, tracked.best().Pose(body));
    tracked = predicted;
    tracked.Update(body, MeasurePoints(cloud_, labeled), true);
    if (!tracked.is_decided()) break;
  }
  NoticeLoss(trunk.has_value(), dt_s);
  if (person_ && is_bad_) LocateAgain();
}

void PaperStages::NoticeLoss(bool has_trunk, double dt_s) {
  const auto& [body, tracked] = *person_;
  is_bad_ = !has_trunk || tracked.residual_mm() > kLostResidualMm ||
            !tracked.best().Pose(body).IsFinite();
  bad_s_ = is_bad_ ? bad_s_ + dt_s : 0;
  if (bad_s_ >= kForgottenAfterS) person_.reset();
}

void PaperStages::LocateAgain() {
  if (const auto located = mikic2003::LocateBody(cloud_)) {
    person_->tracked =
        OrientedBody(person_->body, located->R_WT, MeasurePoints(cloud_, located->frame));
  }
}

BodyPoints PaperStages::points_W() const {
  const auto& [body, tracked] = *person_;
  return body.PointsAt(body.PostureAt(tracked.best().Pose(body)));
}

}  // namespace mocap
