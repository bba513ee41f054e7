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
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/people_watch.h"
#include "daemon/pipeline/tap.h"

namespace mocap {

/// One camera's recent silhouettes compared with those the other cameras predict.
struct CameraHealth {
  int moments = 0;                     ///< Comparisons made; the rest is valid if there are some.
  Vector2 shift_px = Vector2::Zero();  ///< Median, to the right and down: seen minus predicted.
  double overlap = 0;                  ///< Mean intersection over union.
};

/// The silhouettes of a set that will be compared.
struct SeenSet {
  std::int64_t capture_ns = 0;
  std::vector<int> cameras;
  std::vector<Silhouette> silhouettes;
  std::vector<RigidTransform> X_CW;
};
using SetTap = Tap<SeenSet>;

/// Occasionally compares a set's silhouettes with the hulls from the other cameras, and looks for
/// people whom the cameras see, in a thread of low priority.
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

  const std::vector<SensorPlaneTable> tables_;
  HullAgreement agreement_;
  PeopleWatch people_watch_;
  std::optional<Vector3> last_place_W_;
  mutable std::mutex mutex_;
  std::vector<std::deque<SilhouetteShift>> shifts_;  ///< The latest per camera.
  SeenPeople people_;
  Doorbell bell_;
  SetTap tap_;
  std::thread thread_;
};

}  // namespace mocap
