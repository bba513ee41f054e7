#include "core/kernels/mixing.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/mixing.cpp"
#include "core/kernels/each_target.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

void MixFloats(const float* top, const float* bottom, int count, float a, float b, float* to) {
  const float w0 = (1 - a) * (1 - b), w1 = a * (1 - b), w2 = (1 - a) * b, w3 = a * b;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x)
    to[x] = w0 * top[x] + w1 * top[x + 1] + w2 * bottom[x] + w3 * bottom[x + 1];
}

void MixBytes(const std::uint8_t* top, const std::uint8_t* bottom, int count,
              const std::array<int, 4>& weights, std::uint8_t* to) {
  const auto [w0, w1, w2, w3] = weights;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x)
    to[x] = static_cast<std::uint8_t>(
        (w0 * top[x] + w1 * top[x + 1] + w2 * bottom[x] + w3 * bottom[x + 1] + 128) >> 8);
}

void MixTwoRows(const float* top, const float* bottom, int count, float b, float* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) to[i] = top[i] + b * (bottom[i] - top[i]);
}

template <int width>
HWY_INLINE void SpreadCellsOf(const float* corners, int count, float into, float* to) {
  for (int i = 0; i < count; ++i) {
    const float step = corners[i + 1] - corners[i];
#pragma GCC ivdep
    for (int k = 0; k < width; ++k)
      to[i * width + k] = corners[i] + (into + static_cast<float>(k) / width) * step;
  }
}

void SpreadAll(const float* corners, int count, int width, float into, float* to) {
  if (width == 4) SpreadCellsOf<4>(corners, count, into, to);
  if (width == 8) SpreadCellsOf<8>(corners, count, into, to);
}

// Signed, because processors convert no unsigned integers.
HWY_INLINE float ByteOf(PackedPixel p, int shift) {
  return static_cast<float>(static_cast<int>(p >> shift & 255));
}

// A channel between four pixels, with their weights.
struct FourPixels {
  PackedPixel p0, p1, p2, p3;
  float w0, w1, w2, w3;
  HWY_INLINE float Mixed(int shift) const {
    return w0 * ByteOf(p0, shift) + w1 * ByteOf(p1, shift) + w2 * ByteOf(p2, shift) +
           w3 * ByteOf(p3, shift);
  }
};

void Between(const PackedPixel* pixels, int stride, const float* from_x, const float* from_y,
             int count, const std::array<float*, 3>& color, std::uint8_t* slope) {
  const auto [b, g, r] = color;
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
    const FourPixels four = {p0, p1, p2, p3, w0, w1, w2, w3};
    b[i] = four.Mixed(0);
    g[i] = four.Mixed(8);
    r[i] = four.Mixed(16);
    const PackedPixel near_top = u > 0.5f ? p1 : p0, near_bottom = u > 0.5f ? p3 : p2;
    slope[i] = static_cast<std::uint8_t>((v > 0.5f ? near_bottom : near_top) >> 24);
  }
}

void Nearest(const PackedPixel* pixels, int stride, const float* from_x, const float* from_y,
             int count, const std::array<std::uint8_t*, 3>& color, std::uint8_t* slope) {
  const auto [b, g, r] = color;
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
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(MixFloats);
void MixNeighbours(const float* top, const float* bottom, int count, float a, float b, float* to) {
  HWY_DYNAMIC_DISPATCH(MixFloats)(top, bottom, count, a, b, to);
}

HWY_EXPORT(MixBytes);
void MixByteNeighbours(const std::uint8_t* top, const std::uint8_t* bottom, int count,
                       const std::array<int, 4>& weights, std::uint8_t* to) {
  HWY_DYNAMIC_DISPATCH(MixBytes)(top, bottom, count, weights, to);
}

HWY_EXPORT(MixTwoRows);
void MixRows(const float* top, const float* bottom, int count, float b, float* to) {
  HWY_DYNAMIC_DISPATCH(MixTwoRows)(top, bottom, count, b, to);
}

HWY_EXPORT(SpreadAll);
void SpreadCells(const float* corners, int count, int width, float into, float* to) {
  HWY_DYNAMIC_DISPATCH(SpreadAll)(corners, count, width, into, to);
}

HWY_EXPORT(Between);
void ReadBetween(const PackedPixel* pixels, int stride, const float* x, const float* y, int count,
                 const std::array<float*, 3>& color, std::uint8_t* slope) {
  HWY_DYNAMIC_DISPATCH(Between)(pixels, stride, x, y, count, color, slope);
}

HWY_EXPORT(Nearest);
void ReadNearestHalf(const PackedPixel* pixels, int stride, const float* x, const float* y,
                     int count, const std::array<std::uint8_t*, 3>& color, std::uint8_t* slope) {
  HWY_DYNAMIC_DISPATCH(Nearest)(pixels, stride, x, y, count, color, slope);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
