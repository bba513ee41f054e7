// The paper's Fig. 1 from voxels on: acquire the body, track it, lose it, acquire again.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_part.h"
#include "core/body/pose_state.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// What the system knows of the person: nobody there; body being measured; body followed; body no
/// longer matched.
enum class CaptureState { kSearching = 0, kAcquiring = 1, kTracking = 2, kLost = 3 };

inline constexpr std::array<std::string_view, 4> kCaptureStateNames = {"searching", "acquiring",
                                                                       "tracking", "lost"};

/// What one frame set shows of a person, and of all who are with him. Borrowed.
struct Sighting {
  /// Of a person who is alone, and may be anywhere in the grid.
  Sighting(const VoxelGrid& grid, std::span<const Outline> rays)
      : Sighting(grid, rays, {grid.origin_W(), grid.end_W()}) {}
  /// Of a person who is alone, and is within a box.
  Sighting(const VoxelGrid& grid, std::span<const Outline> rays, const Eigen::AlignedBox3d& box)
      : Sighting(grid, rays, box, grid, rays) {}
  Sighting(const VoxelGrid& grid, std::span<const Outline> rays, const Eigen::AlignedBox3d& box,
           const VoxelGrid& everybody, std::span<const Outline> all_rays)
      : flesh(grid), outlines(rays), box_W(box), room(everybody), borders(all_rays) {}

  const VoxelGrid& flesh;             ///< The person's voxels.
  std::span<const Outline> outlines;  ///< The rays that graze the person; one outline a camera.
  Eigen::AlignedBox3d box_W;          ///< The person is in it, flesh that was carved away too [mm].
  const VoxelGrid& room;              ///< Everybody's voxels in the same block of cells.
  std::span<const Outline> borders;   ///< The rays that graze anybody near the person.
};

/// The outcome of one frame set.
struct CaptureResult {
  CaptureState state = CaptureState::kSearching;
  PoseState pose;  ///< Meaningful unless searching.
  Eigen::Matrix<double, 3, kPointCount>
      points_W;  ///< p_WQ of the 23 model points after the filter [mm].
  Eigen::Matrix<double, 1, kPointCount>
      point_std_mm;           ///< Standard deviation of each, along its worst axis [mm].
  double residual_mm = 0;     ///< Mean distance between measured and model points.
  int voxels = 0;             ///< Of the person.
  bool body_changed = false;  ///< The sizes in body() are new with this frame.
};

/// The two halves of an update that a profile tells apart: from voxels to measured points, and from
/// those to a pose. Acquisition counts as labelling.
enum class UpdateStage { kLabel, kFilter };

/// Hears when a stage of an update has ended, because core has no clock of its own. A stage may end
/// more than once an update.
class UpdateObserver {
 public:
  virtual ~UpdateObserver() = default;
  virtual void OnStageEnd(UpdateStage stage) = 0;
};

/// Follows one person through voxel grids, measuring the body first. Same input, same output, bit
/// for bit.
class MotionCapture {
 public:
  virtual ~MotionCapture() = default;

  /// Takes the next frame set.
  /// @param capture_ns  time of exposure; must not go back.
  /// @param observer    told of the stages, may be null; the result does not depend on it.
  virtual const CaptureResult& Update(const Sighting& sighting, std::int64_t capture_ns,
                                      UpdateObserver* observer = nullptr) = 0;

  /// Forgets the person: whoever is seen next is measured.
  virtual void Forget() = 0;
  /// Takes a person's sizes as known: whoever is seen from now on is followed with them, and
  /// nothing is measured until Forget.
  virtual void Expect(const BodySizes& sizes) = 0;

  /// What the last update came to.
  virtual const CaptureResult& result() const = 0;
  /// Where the person will be at a later time if nothing unforeseen happens.
  /// @pre  the last state was not searching.
  virtual PoseState PredictedPose(std::int64_t capture_ns) const = 0;
  /// The body as it is known now.
  virtual const BodyModel& body() const = 0;
  /// Frames that acquisition took from the person's appearance until the sizes settled; 0 before
  /// that.
  virtual int acquisition_frames() const = 0;
};

}  // namespace mocap
