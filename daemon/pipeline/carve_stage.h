// From the cameras' silhouettes to one voxel grid a set.
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
#include "daemon/pipeline/health_watch.h"
#include "daemon/pipeline/load_control.h"
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
  std::vector<Outline> outlines;  ///< One a camera; empty of those that are not in.
  std::vector<CameraEye> eyes;    ///< Of the cameras that are in.
  /// Where a person who is alone can be [mm, world]; empty without anybody.
  Eigen::AlignedBox3d person_box_W;
  std::int64_t frame = 0;        ///< Counts sets from 0.
  std::int64_t capture_ns = 0;   ///< The middle one of the members' times.
  std::int64_t complete_ns = 0;  ///< When the last member had arrived, on the timeline.
  std::int64_t work_ns = 0;      ///< The slowest member's segmentation, and carving.
  std::uint64_t cameras = 0;     ///< Bit i: camera i is in.
};

/// A set with the memory that a person needs, so that later ones need none.
CarvedSet RoomySet(std::size_t cameras, double voxel_mm);

/// Matches silhouettes by time and carves each set. One thread; counters and wanted_from_ns: any.
class CarveStage {
 public:
  /// @param rays  of an outline, at the most.
  CarveStage(const std::vector<CameraCalibration>& cameras, Synchronizer synchronizer,
             const CarvingOptions& options, int rays, StageRecorders& recorders);
  /// Leaves out sets when there is too much to do. Without it, every set is carved.
  void ControlLoad() { load_control_.emplace(); }
  /// Offers copies of a set's silhouettes now and then; borrowed for the stage's life.
  void Show(SetTap& tap) { seen_ = &tap; }

  int camera_count() const { return static_cast<int>(cameras_.size()); }
  bool NeedsFrame(int camera) const { return !synchronizer_.has_front(camera); }
  /// Takes a camera's next frame; the silhouettes change places, so that memory goes round. What is
  /// not wanted any more is dropped.
  void Offer(int camera, SegmentedFrame& frame);
  Synchronizer& synchronizer() { return synchronizer_; }
  /// Frames captured before this are not worth segmenting. Any thread.
  const std::atomic<std::int64_t>& wanted_from_ns() const { return wanted_from_ns_; }

  /// Tells how many sets have been handed on; without load control that means nothing.
  void SetTracked(std::int64_t sets);
  /// Sets that have been matched and not yet tracked, as of the last SetTracked; 0 without load
  /// control.
  std::int64_t under_way() const { return under_way_; }
  /// Takes the synchronizer's next decision; a set is carved into `set`.
  Synchronizer::Verdict Next(CarvedSet& set);

  std::int64_t complete_sets() const { return complete_sets_.load(std::memory_order_relaxed); }
  std::int64_t partial_sets() const { return partial_sets_.load(std::memory_order_relaxed); }
  /// Sets that were left out because there was too much to do.
  std::int64_t skipped_sets() const { return skipped_sets_.load(std::memory_order_relaxed); }
  /// Segmented frames that were not wanted any more.
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
  void CompleteSilhouettes();
  void OfferToWatch();
  void PublishLoad();

  std::deque<Camera> cameras_;  // Cameras with counters do not move.
  Synchronizer synchronizer_;
  std::optional<LoadControl> load_control_;
  FloorShadows shadows_;
  const int rays_;
  Carver carver_;
  StageRecorders& recorders_;
  std::vector<CarvingView> views_;
  std::vector<ShadedView> shaded_;
  SetTap* seen_ = nullptr;
  Pacer seen_pacer_{HealthWatch::kHz};
  std::int64_t next_frame_ = 0;
  std::int64_t under_way_ = 0;
  std::atomic<std::int64_t> wanted_from_ns_{std::numeric_limits<std::int64_t>::min()};
  std::atomic<std::int64_t> skipped_sets_{0};
  std::atomic<std::int64_t> complete_sets_{0};
  std::atomic<std::int64_t> partial_sets_{0};
};

}  // namespace mocap
