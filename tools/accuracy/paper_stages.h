// The stages of the paper's tracker (core/mikic2003), with truth in place of some of them.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "core/mikic2003/orientation.h"
#include "core/reconstruction/carving/voxel_cloud.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "tools/accuracy/true_subject.h"

namespace mocap {

/// Tracks a person of known sizes, as mikic2003::MikicCapture does, from any first pose, and with
/// true labels if wanted. Without them, the same first pose is followed by the same poses, bit for
/// bit.
class PaperStages {
 public:
  /// Starts at a pose, again if a person is followed already.
  /// @param body  the paper's, with the person's sizes.
  void Start(const BodyModel& body, const mikic2003::OrientedBody& first);
  /// Whether a person is followed; otherwise nobody was there for a second, or fitted.
  bool has_started() const { return person_.has_value(); }

  /// Processes the next frame. Fig. 4.
  /// @pre has_started()
  /// @param dt_s        time since the last frame.
  /// @param true_parts  labels what is neither head nor torso, in place of Fig. 8 (e) and (f);
  /// null: the prediction does.
  void Follow(const VoxelGrid& flesh, double dt_s, const TrueParts* true_parts);

  /// Whether the body fits, as in CaptureState::kTracking.
  bool is_tracked() const { return person_ && !is_bad_; }
  /// p_WQ of the 23 points [mm]. @pre has_started()
  BodyPoints points_W() const;

 private:
  struct Person {
    BodyModel body;
    mikic2003::OrientedBody tracked;
  };

  void NoticeLoss(bool has_trunk, double dt_s);
  void LocateAgain();

  VoxelCloud cloud_;
  std::optional<Person> person_;
  bool is_bad_ = false;
  double bad_s_ = 0;
};

}  // namespace mocap
