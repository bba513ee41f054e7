#include "core/reconstruction/background/view_warp.h"

#include "core/reconstruction/background/half_picture.h"

namespace mocap {
namespace {

PackedPixel Pack(std::uint8_t b, std::uint8_t g, std::uint8_t r, std::uint8_t slope) {
  return b | g << 8 | r << 16 | static_cast<PackedPixel>(slope) << 24;
}

}  // namespace

BackgroundView::BackgroundView(const PanTiltAngles& view_angles, const RigidTransform& X_CW_of_view,
                               const Image<Bgr>& image)
    : angles(view_angles),
      X_CW(X_CW_of_view),
      width(image.width()),
      height(image.height()),
      half_width(width / 2),
      half_height(height / 2) {
  std::vector<float> brightness;
  for (const Bgr& p : image.pixels()) brightness.push_back(static_cast<float>(p.b + p.g + p.r) / 3);
  const std::vector<std::uint8_t> slope = SlopeOf(brightness, width, height);
  for (std::size_t i = 0; i < slope.size(); ++i) {
    const Bgr& p = image.pixels()[i];
    pixels.push_back(Pack(p.b, p.g, p.r, slope[i]));
  }
  ExpectedHalf whole(width, height);
  whole.LearnFrom(image.view());
  const auto& color = whole.mean.color;
  for (int y = 0; y < half_height; ++y) {
    for (int x = 0; x < half_width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * whole.mean.width + x;
      half.push_back(Pack(color[0][i], color[1][i], color[2][i], whole.slope[i]));
    }
  }
}

void DrawBetween(const BackgroundView& view, const ViewPlaces& places, int count,
                 const std::array<float*, 3>& color, std::uint8_t* slope) {
  kernels::ReadBetween(view.pixels.data(), view.width, places.x, places.y, count, color, slope);
}

void DrawNearest(const BackgroundView& view, const ViewPlaces& places, int count,
                 const std::array<std::uint8_t*, 3>& color, std::uint8_t* slope) {
  kernels::ReadNearestHalf(view.half.data(), view.half_width, places.x, places.y, count, color,
                           slope);
}

}  // namespace mocap
