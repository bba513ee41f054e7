// The empty studio as one camera sees it: colours, depths, and which pixels show the floor.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "drivers/virtual_studio/room/room.h"

namespace mocap::simulation {

/// A place on the floor in 1/8 mm from its corner. kNoFloor in x if a pixel shows something else.
struct FloorPlace {
  std::uint16_t x = 0, y = 0;
};
inline constexpr std::uint16_t kNoFloor = 0xffff;
inline constexpr float kFloorUnitsPerMm = 8;

struct EmptyView {
  Image<Bgr> image;
  Image<float> nearness;  ///< 1 / z_C [1/mm].
  Image<FloorPlace> floor;
};

/// Renders the empty room through one lens. Immutable; reentrant.
class EmptyViewRenderer {
 public:
  explicit EmptyViewRenderer(const CameraCalibration& camera);

  /// Renders the room from a pose; reuses the view's memory.
  void Render(const Room& room, const RigidTransform& X_CW, EmptyView& view) const;

 private:
  int width_px_, height_px_;
  /// (Xu/f, Yu/f, 1) at the pixels' centres and corners.
  Image<Eigen::Vector3f> centers_, corners_;
};

}  // namespace mocap::simulation
