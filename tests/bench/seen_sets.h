// What many cameras see of a simulated walk, segmented before anything is measured.
#pragma once

#include <vector>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/floor_shadows.h"
#include "core/reconstruction/silhouette/outline.h"
#include "core/reconstruction/silhouette/shading.h"

namespace mocap::bench {

/// Silhouettes of all cameras without their pictures, which would be gigabytes.
class SeenSets {
 public:
  static constexpr int kSets = 12;
  static constexpr double kFps = 30;

  /// What one camera makes of its picture.
  struct Seen {
    Trimap trimap;
    Shading shading;
    Outline outline;
  };

  /// Renders what has not been rendered yet; kept until the program ends.
  static const SeenSets& Get(int cameras);

  const std::vector<CameraCalibration>& cameras() const { return cameras_; }
  const std::vector<Seen>& set(int index) const { return sets_[static_cast<std::size_t>(index)]; }
  /// The set that comes so late, where the walk goes to its end and back again.
  static int SetAt(int index);
  /// A set as it is carved, of silhouettes that are borrowed.
  std::vector<CarvingView> Views(const std::vector<Seen>& set) const;
  /// The same as its shadows are looked at, which completes the silhouettes.
  std::vector<ShadedView> Shaded(std::vector<Seen>& set) const;
  std::vector<CameraEye> Eyes() const;

 private:
  explicit SeenSets(int cameras);

  std::vector<CameraCalibration> cameras_;
  std::vector<SensorPlaneTable> tables_;
  std::vector<std::vector<Seen>> sets_;  // By set, then by camera.
};

}  // namespace mocap::bench
