// Which way a person probably looks: where the feet point, and where the person walks.
#pragma once

#include <optional>
#include <vector>

#include "core/evidence/feet.h"

namespace mocap {

/// What is known of where a person looks.
struct Heading {
  std::optional<Vector3> toes_W;   ///< Where the feet point; see FeetFinder.
  std::optional<Vector3> walks_W;  ///< Where the person walks; empty if slowly.
};

/// Finds the heading in frame after frame.
class HeadingWatch {
 public:
  /// Forgets the way of the last person.
  void StartOver() { way_.clear(); }
  /// Processes a frame. @param dt_s  time since the one before.
  Heading Look(const VoxelCloud& cloud, double dt_s);

 private:
  struct Place {
    double time_s;
    Vector3 p_W;
  };
  std::optional<Vector3> Way(const Vector3& p_W);

  FeetFinder feet_;
  std::vector<Place> way_;  ///< Of the voxels' middle.
  double time_s_ = 0;
};

}  // namespace mocap
