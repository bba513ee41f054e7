// The paper's Fig. 1 from voxels on: acquire the body, track it, lose it, acquire again.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_part.h"
#include "core/body/foot_contacts.h"
#include "core/body/pose_state.h"
#include "core/evidence/keypoint_rays.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// State of the capture: nobody there; sizes being measured; body tracked; body no longer matched.
/// Only in takes that were solved: not matched, but the sets before and after show the motion.
enum class CaptureState { kSearching = 0, kAcquiring = 1, kTracking = 2, kLost = 3, kBridged = 4 };

inline constexpr std::array<std::string_view, 5> kCaptureStateNames = {
    "searching", "acquiring", "tracking", "lost", "bridged"};

/// The evidence of one frame set for a person, and for all people nearby. Borrowed.
struct Observation {
  /// A single person, anywhere in the grid.
  Observation(const VoxelGrid& grid, std::span<const Outline> rays)
      : Observation(grid, rays, {grid.origin_W(), grid.end_W()}) {}
  /// A single person within a box.
  Observation(const VoxelGrid& grid, std::span<const Outline> rays, const Eigen::AlignedBox3d& box)
      : Observation(grid, rays, box, grid, rays) {}
  Observation(const VoxelGrid& grid, std::span<const Outline> rays, const Eigen::AlignedBox3d& box,
              const VoxelGrid& everybody, std::span<const Outline> all_rays)
      : flesh(grid), outlines(rays), box_W(box), room(everybody), borders(all_rays) {}

  const VoxelGrid& flesh;             ///< The person's voxels.
  std::span<const Outline> outlines;  ///< The rays that graze the person; one outline per camera.
  Eigen::AlignedBox3d box_W;          ///< Contains the person, with any carved-away flesh [mm].
  const VoxelGrid& room;              ///< Everybody's voxels in the same block of cells.
  std::span<const Outline> borders;   ///< The rays that graze anybody near the person.
  /// Cells of `flesh` that no camera denies, but too few show.
  std::span<const Eigen::Vector3i> doubtful;
  std::span<const KeypointRays> keypoints;  ///< What pose networks say of the person.
};

using PointStds = Eigen::Matrix<double, 1, kPointCount>;
using FurtherStds = Eigen::Matrix<double, 1, kFurtherPointCount>;

/// How well a view of keypoints agrees with the pose.
struct KeypointAgreement {
  int view = 0;          ///< As in KeypointRays.
  double agreement = 0;  ///< Probability that the view is right, 0 to 1.
};

/// Another pose that a person may have.
struct RivalPose {
  double probability = 0;                    ///< 0 to 1.
  BodyPoints points_W = BodyPoints::Zero();  ///< As in CaptureResult.
};

/// The result of one frame set.
struct CaptureResult {
  CaptureState state = CaptureState::kSearching;
  PoseState pose;  ///< Undefined while searching.
  /// p_WQ of the 23 model points after the filter [mm]; zero until somebody is tracked.
  BodyPoints points_W = BodyPoints::Zero();
  /// Standard deviation of each, along its worst axis [mm].
  PointStds point_std_mm = PointStds::Zero();
  /// The points that follow the 23, and their deviations; NaN: the body does not have them apart.
  FurtherPoints further_W = FurtherPoints::Constant(std::numeric_limits<double>::quiet_NaN());
  FurtherStds further_std_mm = FurtherStds::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Standard deviations of the joint angles [rad]; empty: not known.
  JointAngles joint_std_rad = {};
  /// How likely heels and toes touch the floor, 0 to 1; NaN: not known.
  Contacts contacts = kUnknownContacts;
  FootMotions foot_motions = {};  ///< What contacts are judged by, where they are known.
  /// Of the pose, 0 to 1. Empty: nobody is there, or the tracker cannot tell.
  std::optional<double> probability;
  std::optional<RivalPose> rival;  ///< The likeliest of the other poses, if there are any.
  std::vector<KeypointAgreement> agreements = {};  ///< Of this set's keypoints.
  double residual_mm = 0;     ///< Mean distance between measured and model points.
  int voxels = 0;             ///< Of the person.
  bool body_changed = false;  ///< The sizes in body() have changed in this frame.
};

/// The two stages of an update for profiling: from voxels to measured points, and from points to a
/// pose. Acquisition counts as labelling.
enum class UpdateStage { kLabel, kFilter };

/// Receives the end of each stage of an update, because core has no clock of its own. A stage may
/// end more than once per update.
class UpdateObserver {
 public:
  virtual ~UpdateObserver() = default;
  virtual void OnStageEnd(UpdateStage stage) = 0;
};

/// Tracks one person through voxel grids, after measuring the body. The same input gives the same
/// output, bit for bit.
class MotionCapture {
 public:
  virtual ~MotionCapture() = default;

  /// Processes the next frame set.
  /// @param capture_ns  time of exposure; one before the last counts as the same time.
  /// @param observer    told of the stages, may be null; the result does not depend on it.
  virtual const CaptureResult& Update(const Observation& observation, std::int64_t capture_ns,
                                      UpdateObserver* observer = nullptr) = 0;

  /// Forgets the person: the next person is measured.
  virtual void Forget() = 0;
  /// Sets the sizes as known: everybody seen from now on is tracked with them, and nothing is
  /// measured until Forget.
  virtual void Expect(const BodySizes& sizes) = 0;

  /// Returns the result of the last update.
  virtual const CaptureResult& result() const = 0;
  /// Predicts the pose at a later time.
  /// @pre  the last state was not searching.
  virtual PoseState PredictedPose(std::int64_t capture_ns) const = 0;
  /// Returns the body as estimated so far.
  virtual const BodyModel& body() const = 0;
  /// Number of frames from the person's appearance until the sizes settled; 0 before that.
  virtual int acquisition_frames() const = 0;
};

}  // namespace mocap
