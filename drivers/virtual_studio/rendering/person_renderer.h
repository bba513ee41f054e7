// Draws people into a camera's picture of the empty studio.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "drivers/virtual_studio/people/person_mesh.h"
#include "drivers/virtual_studio/rendering/empty_view.h"
#include "drivers/virtual_studio/rendering/floor_shadow.h"
#include "drivers/virtual_studio/rendering/low_contrast.h"
#include "drivers/virtual_studio/rendering/pixel_box.h"
#include "drivers/virtual_studio/rendering/soft_shadows.h"

namespace mocap::simulation {

/// A person to draw; at most 31.
struct Figure {
  Outfit outfit;
  PersonMesh mesh;
};

/// Content of a pixel: a figure and its material; 0 is no figure.
class FigurePixel {
 public:
  static std::uint8_t Of(std::size_t figure, Material material) {
    return static_cast<std::uint8_t>((figure + 1) << kMaterialBits | material);
  }
  static constexpr int FigureOf(std::uint8_t pixel) { return (pixel >> kMaterialBits) - 1; }
  static constexpr Material MaterialOf(std::uint8_t pixel) {
    return static_cast<Material>(pixel & ((1 << kMaterialBits) - 1));
  }

  /// Bits of eight pixels that identify the figure, without the material.
  static constexpr std::uint64_t kWhoOfEight = 0xf8f8f8f8f8f8f8f8;

 private:
  static constexpr int kMaterialBits = 3;
  static_assert(kMaterialCount <= 1 << kMaterialBits);
};

/// What of people cannot be seen: it looks exactly like the empty room behind it.
enum class HiddenClothes { kNone, kShirts, kTrousers };

/// How people look to one camera.
struct FigureStyle {
  double contrast = 0;        ///< As in SimulatedStudioOptions,
  bool soft_shadows = false;  ///< and this.
  HiddenClothes hidden = HiddenClothes::kNone;
};

/// A z-buffer for one camera; reuses its memory. Thread-bound.
class PersonRenderer {
 public:
  explicit PersonRenderer(const CameraCalibration& camera, const FigureStyle& style = {});

  /// Draws shadows and figures over the empty view.
  ///
  /// The lens is evaluated at every vertex. Objects in front of a figure hide it.
  /// @param poses   one per figure.
  /// @param canvas  gets the picture. With `same_view` it must be the empty view, except where the
  /// last
  ///                call drew.
  void Draw(std::span<const Figure> figures, std::span<const BonePoses> poses,
            const EmptyView& view, const RigidTransform& X_CW, bool same_view, Image<Bgr>& canvas);

  /// The figures visible in the last picture: a FigurePixel each.
  const Image<std::uint8_t>& figures() const { return figures_; }

 private:
  struct ScreenVertex {
    float x, y, nearness;  // Nearness 0: not in the camera's field.
    float shade;
  };
  // A figure's skin in the world frame.
  struct Skin {
    std::vector<Eigen::Vector3f> p_W, n_W;
  };
  // Projects a skin's vertices; returns the pixels that may show it.
  PixelBox Project(const PersonMesh& mesh, const Skin& skin, const RigidTransform& X_CW,
                   std::vector<ScreenVertex>& screen) const;
  void DrawSoftShadows(std::span<const Figure> figures, Image<Bgr>& canvas);
  void DrawShadow(std::span<const Figure> figures, const EmptyView& view,
                  const RigidTransform& X_CW, Image<Bgr>& canvas);
  // Applies the shadow to pixels that show these places.
  void Darken(std::span<const FloorPlace> floor, Bgr* pixels) const;
  void DrawTriangle(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                    std::uint8_t pixel);
  void Compose(std::span<const Figure> figures, const Image<Bgr>& empty, Image<Bgr>& canvas);
  void SoftenEdges(Image<Bgr>& canvas);
  bool IsOutlineWithin(int x, int y) const;
  bool ToScreen(const Eigen::Vector3f& p_C, float& x, float& y) const;

  int width_px_, height_px_;
  HiddenClothes hidden_;
  std::optional<LowContrast> low_contrast_;
  std::optional<SoftShadows> soft_shadows_;  // In place of shadow_.
  TsaiLens lens_;
  float fx_, fy_, cx_, cy_, kappa_;
  std::vector<float> shrink_;  // rd / ru as a function of κ1 ru².
  std::vector<Skin> skins_;
  std::vector<std::vector<ScreenVertex>> screens_;
  Image<float> nearness_, shades_;
  Image<std::uint8_t> figures_;
  FloorShadow shadow_;
  PixelBox people_, dirty_;
  struct Soft {
    int x, y;
    Bgr color;
  };
  std::vector<Soft> soft_;
};

}  // namespace mocap::simulation
