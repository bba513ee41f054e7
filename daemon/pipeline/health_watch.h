// Whether the cameras still stand where they were calibrated, looked at while they run.
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
#include "daemon/pipeline/tap.h"

namespace mocap {

/// What one camera saw of the person, lately, against what the others make of him.
struct CameraHealth {
  int moments = 0;                     ///< That could be compared; the rest is known with some.
  Vector2 shift_px = Vector2::Zero();  ///< Median, to the right and down: seen minus expected.
  double overlap = 0;                  ///< Mean intersection over union.
};

/// A set's silhouettes on their way to be compared.
struct SeenSet {
  std::vector<int> cameras;
  std::vector<Silhouette> silhouettes;
  std::vector<RigidTransform> X_CW;
};
using SetTap = Tap<SeenSet>;

/// Compares now and then a set's silhouettes with each other's hulls, in a thread of its own that
/// comes after everything else.
class HealthWatch {
 public:
  /// How often a set is wanted at most.
  static constexpr double kHz = 0.5;
  /// Fewer moments say nothing.
  static constexpr int kFewestMoments = 4;

  explicit HealthWatch(const std::vector<CameraCalibration>& cameras);
  ~HealthWatch();

  /// Where the pipeline leaves sets.
  SetTap& tap() { return tap_; }
  /// One for each camera. Any thread.
  std::vector<CameraHealth> Health() const;

  /// What the thread does with a set.
  void Add(const SeenSet& set);

 private:
  void Run();

  const std::vector<SensorPlaneTable> tables_;
  HullAgreement agreement_;
  std::optional<Vector3> last_place_W_;
  mutable std::mutex mutex_;
  std::vector<std::deque<SilhouetteShift>> shifts_;  ///< The latest of each camera.
  Doorbell bell_;
  SetTap tap_;
  std::thread thread_;
};

}  // namespace mocap
