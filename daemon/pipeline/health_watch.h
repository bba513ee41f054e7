// Checks during operation whether the cameras still are where they were calibrated.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/carving/hull_agreement.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/silhouette/trimap.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/people_watch.h"
#include "daemon/pipeline/tap.h"

namespace mocap {

/// One camera's recent silhouettes compared with those the other cameras predict.
struct CameraHealth {
  int moments = 0;                     ///< Comparisons made; the rest is valid if there are some.
  Vector2 shift_px = Vector2::Zero();  ///< Median, to the right and down: seen minus predicted.
  double overlap = 0;                  ///< Mean intersection over union.
  /// Share of unknown pixels where the camera shows people, in the latest moments; empty before.
  std::optional<double> unknown_share = {};
  /// Share of the people that the camera calls empty while the others show them (`MissRates`).
  std::optional<double> miss_rate = {};
};

/// The pictures of a set that will be compared, and what was carved.
struct SeenSet {
  std::int64_t capture_ns = 0;
  std::vector<int> cameras;
  std::vector<Trimap> trimaps;
  std::vector<RigidTransform> X_CW;
  std::vector<std::optional<double>> miss_rates;  ///< As carving knows them.
  VoxelGrid hull;
};
using SetTap = Tap<SeenSet>;

/// Occasionally compares a set's silhouettes with the hulls from the other cameras, looks for
/// people whom the cameras see, and measures what of them is unknown, in a thread of low priority.
class HealthWatch {
 public:
  /// Maximum rate of sets.
  static constexpr double kHz = 0.5;
  /// Fewer moments are not conclusive.
  static constexpr int kFewestMoments = 4;

  explicit HealthWatch(const std::vector<CameraCalibration>& cameras);
  ~HealthWatch();

  /// The pipeline offers sets here.
  SetTap& tap() { return tap_; }
  /// One for each camera. Any thread.
  std::vector<CameraHealth> Health() const;
  /// Any thread.
  SeenPeople People() const;

  /// Compares a set; called by the thread.
  void Add(const SeenSet& set);

 private:
  void Run();
  void LookForPeople(const SeenSet& set);
  void CompareHulls(const SeenSet& set);
  void MeasureUnknown(const SeenSet& set);

  const std::vector<SensorPlaneTable> tables_;
  HullAgreement agreement_;
  PeopleWatch people_watch_;
  std::optional<Vector3> last_place_W_;
  mutable std::mutex mutex_;
  std::vector<std::deque<SilhouetteShift>> shifts_;  ///< The latest per camera.
  std::vector<std::deque<double>> unknown_;          ///< Likewise, shares.
  std::vector<std::optional<double>> miss_rates_;
  SeenPeople people_;
  Doorbell bell_;
  SetTap tap_;
  std::thread thread_;
};

}  // namespace mocap
