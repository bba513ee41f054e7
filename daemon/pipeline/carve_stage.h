// Turns the cameras' silhouettes into one voxel grid per set.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/floor_shadows.h"
#include "core/reconstruction/carving/miss_rates.h"
#include "daemon/pipeline/health_watch.h"
#include "daemon/pipeline/load_control.h"
#include "daemon/pipeline/moment_history.h"
#include "daemon/pipeline/pacer.h"
#include "daemon/pipeline/segmented_frame.h"
#include "daemon/pipeline/stage.h"
#include "daemon/pipeline/synchronizer.h"

namespace mocap {

inline constexpr int kMaxCameras = Carver::kMostViews;
static_assert(kMaxCameras <= 64, "a set of cameras is one word");

/// One frame set, carved.
struct CarvedSet {
  VoxelGrid grid;
  std::vector<Eigen::Vector3i> doubtful;  ///< Cells that no camera denies, but too few show.
  std::vector<Outline> outlines;          ///< One per camera; empty for cameras not in the set.
  std::vector<CameraEye> eyes;            ///< Of the cameras in the set.
  /// Bounds of a single person [mm, world]; empty without anybody.
  Eigen::AlignedBox3d person_box_W;
  std::int64_t frame = 0;        ///< Counts sets from 0.
  std::int64_t capture_ns = 0;   ///< The mean of the members' times.
  std::int64_t complete_ns = 0;  ///< Arrival of the last member, on the timeline.
  std::int64_t work_ns = 0;      ///< The slowest member's segmentation plus carving.
  std::uint64_t cameras = 0;     ///< Bit i: camera i is in the set.
};

/// A set with enough memory for a person, so that later ones allocate none.
CarvedSet RoomySet(std::size_t cameras, double voxel_mm);

/// Matches silhouettes by time and carves each set. For one thread; counters and wanted_from_ns:
/// any.
class CarveStage {
 public:
  /// @param rays  maximum number per outline.
  CarveStage(const std::vector<CameraCalibration>& cameras, Synchronizer synchronizer,
             const CarvingOptions& options, int rays, StageRecorders& recorders);
  /// Skips sets under overload. Without it, every set is carved.
  void ControlLoad() { load_control_.emplace(); }
  /// Offers copies of a set's trimaps and voxels now and then; borrowed for the stage's life.
  void Show(SetTap& tap) { seen_ = &tap; }
  /// Keeps what is seen at some moments; borrowed likewise.
  void Keep(MomentHistory& history) { history_ = &history; }

  int camera_count() const { return static_cast<int>(cameras_.size()); }
  bool NeedsFrame(int camera) const { return !synchronizer_.has_front(camera); }
  /// Takes a camera's next frame. The silhouettes are swapped, so that memory is reused. A frame
  /// that is no longer wanted is dropped.
  void Offer(int camera, SegmentedFrame& frame);
  Synchronizer& synchronizer() { return synchronizer_; }
  /// Frames captured before this are not worth segmenting. Any thread.
  const std::atomic<std::int64_t>& wanted_from_ns() const { return wanted_from_ns_; }

  /// Sets the number of sets handed on so far. Without load control it has no effect.
  void SetTracked(std::int64_t sets);
  /// Sets matched but not yet tracked, as of the last SetTracked; 0 without load control.
  std::int64_t under_way() const { return under_way_; }
  /// Takes the synchronizer's next decision. A set is carved into `set`.
  Synchronizer::Decision Next(CarvedSet& set);

  std::int64_t complete_sets() const { return complete_sets_.load(std::memory_order_relaxed); }
  std::int64_t partial_sets() const { return partial_sets_.load(std::memory_order_relaxed); }
  /// Sets skipped because of overload.
  std::int64_t skipped_sets() const { return skipped_sets_.load(std::memory_order_relaxed); }
  /// Segmented frames that were no longer wanted.
  std::int64_t left_out(int camera) const {
    return cameras_[camera].left_out.load(std::memory_order_relaxed);
  }
  std::int64_t late(int camera) const {
    return cameras_[camera].late.load(std::memory_order_relaxed);
  }

 private:
  struct Camera {
    explicit Camera(const CameraCalibration& camera) : calibration(camera), table(camera) {}

    const CameraCalibration calibration;
    const SensorPlaneTable table;
    SegmentedFrame front;
    std::atomic<std::int64_t> late{0};
    std::atomic<std::int64_t> left_out{0};
  };

  void Gather(CarvedSet& set);
  void DecideFloor();
  void OfferToWatch(const VoxelGrid& hull);
  SeenMoment PresentMoment() const;
  void PublishLoad();

  std::deque<Camera> cameras_;  // A deque: cameras with counters cannot move.
  Synchronizer synchronizer_;
  std::optional<LoadControl> load_control_;
  FloorShadows shadows_;
  const int rays_;
  Carver carver_;
  const bool is_hard_;
  MissRates miss_rates_;
  StageRecorders& recorders_;
  std::vector<CarvingView> views_;
  std::vector<ShadedView> shaded_;
  SetTap* seen_ = nullptr;
  MomentHistory* history_ = nullptr;
  Pacer seen_pacer_{HealthWatch::kHz};
  std::int64_t next_frame_ = 0;
  std::int64_t under_way_ = 0;
  std::atomic<std::int64_t> wanted_from_ns_{std::numeric_limits<std::int64_t>::min()};
  std::atomic<std::int64_t> skipped_sets_{0};
  std::atomic<std::int64_t> complete_sets_{0};
  std::atomic<std::int64_t> partial_sets_{0};
};

}  // namespace mocap
