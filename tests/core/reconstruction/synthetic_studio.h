// Six Tsai cameras around a room, and silhouettes of capsules cast exactly.
#pragma once

#include <optional>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/carving/carving_view.h"
#include "tests/core/reconstruction/lenses.h"

namespace mocap {

/// All points within a radius of a line segment; a sphere where both ends are the same.
struct DrawnCapsule {
  Vector3 a_W;
  Vector3 b_W;
  double radius_mm = 0;
};

/// Gives the pose of a camera at `eye_W` that looks at `target_W`, with z up.
RigidTransform LookAt(const Vector3& eye_W, const Vector3& target_W);

/// Cameras of one lens, their tables, and silhouettes to carve with.
class SyntheticStudio {
 public:
  /// Six cameras of 320 x 240 pixels in a room of 6 x 6 m that all look at (0, 0, 900).
  SyntheticStudio();
  /// As many as there shall be on a circle around it, at different heights.
  explicit SyntheticStudio(int places);

  std::vector<CameraCalibration> cameras;
  std::vector<Silhouette> silhouettes;
  std::vector<Silhouette> unknown;  ///< Beside them; nothing after Show().

  /// Draws what each camera sees of the capsules.
  void Show(const std::vector<DrawnCapsule>& capsules);
  std::vector<CarvingView> Views() const;

 private:
  explicit SyntheticStudio(const std::vector<Vector3>& eyes_W);

  SensorPlaneTable table_;
  std::vector<std::optional<Vector2>> directions_;
};

/// Erases the lower half of what a silhouette shows, as of trousers in the wall's colour.
void EraseLegs(Silhouette& silhouette);

/// A person of about 1.75 m, standing at (x, y) with the arms out.
std::vector<DrawnCapsule> StandingPerson(double x, double y);

}  // namespace mocap
