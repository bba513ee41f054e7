// Draws the person into one camera's picture of the empty studio.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "drivers/simulation/empty_view.h"
#include "drivers/simulation/floor_shadow.h"
#include "drivers/simulation/person_mesh.h"

namespace mocap::simulation {

/// Half-open rectangle of pixels.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// A z-buffer for one camera; reuses its memory. Thread-bound.
class PersonRenderer {
 public:
  explicit PersonRenderer(const CameraCalibration& camera);

  /// Draws shadow and person over the empty view.
  ///
  /// The camera's lens is evaluated at every vertex; a thing that stands before the person hides
  /// it.
  /// @param canvas  gets the picture; is the empty view outside of what the last call touched when
  ///                `same_view`.
  void Draw(const PersonMesh& mesh, const Outfit& outfit, const BonePoses& bones,
            const EmptyView& view, const RigidTransform& X_CW, bool same_view, Image<Bgr>& canvas);

  /// Where the person was visible in the last picture: material + 1, 0 elsewhere.
  const Image<std::uint8_t>& materials() const { return materials_; }

 private:
  struct ScreenVertex {
    float x, y, nearness;  // Nearness 0: not in the camera's field.
    float shade;
  };
  void Project(const PersonMesh& mesh, const RigidTransform& X_CW);
  void DrawShadow(const EmptyView& view, const RigidTransform& X_CW, Image<Bgr>& canvas);
  // Lets the shadow fall on pixels that show these places.
  void Darken(std::span<const FloorPlace> floor, Bgr* pixels) const;
  void DrawTriangle(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                    Material material);
  void Compose(const Outfit& outfit, Image<Bgr>& canvas);
  void SoftenEdges(Image<Bgr>& canvas);
  bool IsOutlineWithin(int x, int y) const;
  bool ToScreen(const Eigen::Vector3f& p_C, float& x, float& y) const;

  int width_px_, height_px_;
  TsaiLens lens_;
  float fx_, fy_, cx_, cy_, kappa_;
  std::vector<float> shrink_;  // rd / ru by κ1 ru².
  std::vector<Eigen::Vector3f> p_W_, n_W_;
  std::vector<ScreenVertex> screen_;
  Image<float> nearness_, shades_;
  Image<std::uint8_t> materials_;
  FloorShadow shadow_;
  PixelBox person_, dirty_;
  struct Soft {
    int x, y;
    Bgr color;
  };
  std::vector<Soft> soft_;
};

}  // namespace mocap::simulation
