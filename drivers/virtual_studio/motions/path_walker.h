// Walking along a path on the floor, repeatedly.
#pragma once

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/motions/motion.h"

namespace mocap::simulation {

/// Walks or runs along a path at constant speed; on an open path, to its end.
class PathWalker : public Motion {
 public:
  /// @param start_mm  position on the path at time 0.
  PathWalker(const Anthropometry& body, const GaitStyle& style, FloorPath path, double speed_mm_s,
             double start_mm = 0)
      : gait_(body, style, [path = std::move(path), speed_mm_s, start_mm](double t_s) {
          const double distance = speed_mm_s * t_s + start_mm;
          return Track{path.PositionAt(distance), path.HeadingAt(distance)};
        }) {}
  BodyPose PoseAt(double t_s) const override { return gait_.PoseAt(t_s); }

 private:
  Gait gait_;
};

}  // namespace mocap::simulation
