#include "drivers/pixels/pixel_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "drivers/pixels/pixel_rows.cpp"
#include "core/kernels/each_target.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::HWY_NAMESPACE {
namespace {

HWY_INLINE std::uint8_t Clamped(int value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
}

void ToBgrRow(const std::uint8_t* __restrict y, const std::uint8_t* __restrict u,
              const std::uint8_t* __restrict v, int width, std::uint8_t* __restrict out) {
  for (int x = 0; x < width; ++x) {
    const int bright = 298 * (y[x] - 16) + 128;
    const int blue = u[x] - 128, red = v[x] - 128;
    out[3 * x] = Clamped((bright + 516 * blue) >> 8);
    out[3 * x + 1] = Clamped((bright - 100 * blue - 208 * red) >> 8);
    out[3 * x + 2] = Clamped((bright + 409 * red) >> 8);
  }
}

// Splits four bytes of two pixels. `bright` is the index of the first Y, `colour` that of U.
template <int bright, int colour>
HWY_INLINE void Unpack(const std::uint8_t* __restrict in, int pairs, std::uint8_t* __restrict y,
                       std::uint8_t* __restrict u, std::uint8_t* __restrict v) {
  for (int i = 0; i < pairs; ++i) {
    y[2 * i] = in[4 * i + bright];
    y[2 * i + 1] = in[4 * i + bright + 2];
    u[2 * i] = u[2 * i + 1] = in[4 * i + colour];
    v[2 * i] = v[2 * i + 1] = in[4 * i + colour + 2];
  }
}

void UnpackYuyvRow(const std::uint8_t* in, int pairs, std::uint8_t* y, std::uint8_t* u,
                   std::uint8_t* v) {
  Unpack<0, 1>(in, pairs, y, u, v);
}
void UnpackUyvyRow(const std::uint8_t* in, int pairs, std::uint8_t* y, std::uint8_t* u,
                   std::uint8_t* v) {
  Unpack<1, 0>(in, pairs, y, u, v);
}
void UnpackPairsRow(const std::uint8_t* __restrict in, int pairs, std::uint8_t* __restrict u,
                    std::uint8_t* __restrict v) {
  for (int i = 0; i < pairs; ++i) {
    u[2 * i] = u[2 * i + 1] = in[2 * i];
    v[2 * i] = v[2 * i + 1] = in[2 * i + 1];
  }
}

template <bool is_red_row>
HWY_INLINE void FillInside(const MosaicRows& rows, int begin, int width, Bgr* out) {
  for (int x = begin; x + 2 < width; x += 2) {
    out[x] = rows.PixelAt(x - 1, x, x + 1, is_red_row, true);
    out[x + 1] = rows.PixelAt(x, x + 1, x + 2, is_red_row, false);
  }
}

void FillRow(const MosaicRows& rows, bool is_red_row, int begin, int width, Bgr* out) {
  if (is_red_row) {
    FillInside<true>(rows, begin, width, out);
  } else {
    FillInside<false>(rows, begin, width, out);
  }
}

}  // namespace
}  // namespace mocap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap {

HWY_EXPORT(ToBgrRow);
void ToBgr(const std::uint8_t* y, const std::uint8_t* u, const std::uint8_t* v, int width,
           std::uint8_t* bgr) {
  HWY_DYNAMIC_DISPATCH(ToBgrRow)(y, u, v, width, bgr);
}

HWY_EXPORT(UnpackYuyvRow);
void UnpackYuyv(const std::uint8_t* in, int pairs, std::uint8_t* y, std::uint8_t* u,
                std::uint8_t* v) {
  HWY_DYNAMIC_DISPATCH(UnpackYuyvRow)(in, pairs, y, u, v);
}

HWY_EXPORT(UnpackUyvyRow);
void UnpackUyvy(const std::uint8_t* in, int pairs, std::uint8_t* y, std::uint8_t* u,
                std::uint8_t* v) {
  HWY_DYNAMIC_DISPATCH(UnpackUyvyRow)(in, pairs, y, u, v);
}

HWY_EXPORT(UnpackPairsRow);
void UnpackPairs(const std::uint8_t* in, int pairs, std::uint8_t* u, std::uint8_t* v) {
  HWY_DYNAMIC_DISPATCH(UnpackPairsRow)(in, pairs, u, v);
}

HWY_EXPORT(FillRow);
void FillMosaicRow(const MosaicRows& rows, bool is_red_row, int begin, int width, Bgr* out) {
  HWY_DYNAMIC_DISPATCH(FillRow)(rows, is_red_row, begin, width, out);
}

}  // namespace mocap
#endif  // HWY_ONCE
