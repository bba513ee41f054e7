#include "core/reconstruction/background/view_warp.h"

#include "core/reconstruction/background/half_picture.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

PackedPixel Pack(std::uint8_t b, std::uint8_t g, std::uint8_t r, std::uint8_t slope) {
  return b | g << 8 | r << 16 | static_cast<PackedPixel>(slope) << 24;
}

// Signed, because processors convert no unsigned integers.
inline float ByteOf(PackedPixel p, int shift) {
  return static_cast<float>(static_cast<int>(p >> shift & 255));
}

MOCAP_VECTORIZED
void Between(const PackedPixel* pixels, int stride, const float* from_x, const float* from_y,
             int count, float* b, float* g, float* r, std::uint8_t* slope) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const int column = static_cast<int>(from_x[i]);
    const int row = static_cast<int>(from_y[i]);
    const float u = from_x[i] - static_cast<float>(column);
    const float v = from_y[i] - static_cast<float>(row);
    const int at = row * stride + column;
    const PackedPixel p0 = pixels[at], p1 = pixels[at + 1];
    const PackedPixel p2 = pixels[at + stride], p3 = pixels[at + stride + 1];
    const float w0 = (1 - u) * (1 - v), w1 = u * (1 - v), w2 = (1 - u) * v, w3 = u * v;
    const auto mix = [&](int shift) {
      return w0 * ByteOf(p0, shift) + w1 * ByteOf(p1, shift) + w2 * ByteOf(p2, shift) +
             w3 * ByteOf(p3, shift);
    };
    b[i] = mix(0);
    g[i] = mix(8);
    r[i] = mix(16);
    const PackedPixel near_top = u > 0.5f ? p1 : p0, near_bottom = u > 0.5f ? p3 : p2;
    slope[i] = static_cast<std::uint8_t>((v > 0.5f ? near_bottom : near_top) >> 24);
  }
}

MOCAP_VECTORIZED
void Nearest(const PackedPixel* pixels, int stride, const float* from_x, const float* from_y,
             int count, std::uint8_t* b, std::uint8_t* g, std::uint8_t* r, std::uint8_t* slope) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const int column = static_cast<int>(from_x[i] * 0.5f + 0.25f);
    const int row = static_cast<int>(from_y[i] * 0.5f + 0.25f);
    const PackedPixel p = pixels[row * stride + column];
    b[i] = static_cast<std::uint8_t>(p);
    g[i] = static_cast<std::uint8_t>(p >> 8);
    r[i] = static_cast<std::uint8_t>(p >> 16);
    slope[i] = static_cast<std::uint8_t>(p >> 24);
  }
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
  Between(view.pixels.data(), view.width, places.x, places.y, count, color[0], color[1], color[2],
          slope);
}

void DrawNearest(const BackgroundView& view, const ViewPlaces& places, int count,
                 const std::array<std::uint8_t*, 3>& color, std::uint8_t* slope) {
  Nearest(view.half.data(), view.half_width, places.x, places.y, count, color[0], color[1],
          color[2], slope);
}

}  // namespace mocap
