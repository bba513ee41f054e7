// Shadows with wide penumbras, on everything in the room.
#pragma once

#include <array>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "drivers/virtual_studio/people/person_mesh.h"
#include "drivers/virtual_studio/rendering/empty_view.h"
#include "drivers/virtual_studio/rendering/lamps.h"
#include "drivers/virtual_studio/rendering/pixel_box.h"

namespace mocap::simulation {

/// Computes and draws the shadows of people in the light of panels for one camera; reuses its
/// memory. Thread-bound.
///
/// Every point of the room is looked up where the ray from the lamp through it meets the plane of
/// the floor, so walls and furniture have the penumbra of that place. People outside of the room
/// cast none.
class SoftShadows {
 public:
  explicit SoftShadows(const CameraCalibration& camera);

  /// Prepares for pictures of this view.
  void SetView(const EmptyView& view, const RigidTransform& X_CW);
  /// Removes all shadows.
  void Clear();
  /// Adds the shadow of a mesh. @param p_W  its vertices.
  void Cast(const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W);
  /// Darkens a picture of the view. Returns a box around all changed pixels.
  PixelBox Darken(Image<Bgr>& canvas);

 private:
  struct LampShadow {
    HiddenCells hidden;
    std::vector<float> shares;  // Of the lamp, that is hidden from a cell.
  };

  void MeasureShares(LampShadow& lamp) const;
  int LightAt(const Eigen::Vector3f& p_W) const;

  Image<Eigen::Vector3f> rays_C_, points_W_;  // By pixel.
  std::array<LampShadow, kLampCount> lamps_;
};

}  // namespace mocap::simulation
