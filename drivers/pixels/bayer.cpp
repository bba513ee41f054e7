#include "drivers/pixels/bayer.h"

#include "core/errors.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

/// Three rows of the mosaic, around the row to fill.
struct Rows {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;
};

std::uint8_t Mean(int a, int b) { return static_cast<std::uint8_t>((a + b + 1) / 2); }
std::uint8_t Mean(int a, int b, int c, int d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
}

/// The colours at x; `own` is the row's own colour (red or blue).
struct Colours {
  std::uint8_t own, green, other;
};

Colours AtOwn(const Rows& rows, int left, int x, int right) {
  return {rows.here[x], Mean(rows.here[left], rows.here[right], rows.above[x], rows.below[x]),
          Mean(rows.above[left], rows.above[right], rows.below[left], rows.below[right])};
}

Colours AtGreen(const Rows& rows, int left, int x, int right) {
  return {Mean(rows.here[left], rows.here[right]), rows.here[x],
          Mean(rows.above[x], rows.below[x])};
}

template <bool kRedRow>
Bgr Pixel(const Colours& colours) {
  return kRedRow ? Bgr{colours.other, colours.green, colours.own}
                 : Bgr{colours.own, colours.green, colours.other};
}

template <bool kRedRow>
inline __attribute__((always_inline)) void FillInside(const Rows& rows, int begin, int width,
                                                      Bgr* out) {
  for (int x = begin; x + 2 < width; x += 2) {
    out[x] = Pixel<kRedRow>(AtOwn(rows, x - 1, x, x + 1));
    out[x + 1] = Pixel<kRedRow>(AtGreen(rows, x, x + 1, x + 2));
  }
}

MOCAP_VECTORIZED void FillRedRow(const Rows& rows, int begin, int width, Bgr* out) {
  FillInside<true>(rows, begin, width, out);
}
MOCAP_VECTORIZED void FillBlueRow(const Rows& rows, int begin, int width, Bgr* out) {
  FillInside<false>(rows, begin, width, out);
}

void FillPixel(const Rows& rows, bool is_red_row, bool is_own, int x, int width, Bgr* out) {
  const int left = x == 0 ? 1 : x - 1;
  const int right = x == width - 1 ? width - 2 : x + 1;
  const Colours colours = is_own ? AtOwn(rows, left, x, right) : AtGreen(rows, left, x, right);
  out[x] = is_red_row ? Pixel<true>(colours) : Pixel<false>(colours);
}

}  // namespace

void InterpolateBayer(ImageView<const std::uint8_t> mosaic, BayerOrder order, Image<Bgr>& out) {
  const int width = mosaic.width(), height = mosaic.height();
  MOCAP_CHECK(width >= 2 && height >= 2 && out.width() == width && out.height() == height);
  for (int y = 0; y < height; ++y) {
    const Rows rows{mosaic.row(y == 0 ? 1 : y - 1), mosaic.row(y),
                    mosaic.row(y == height - 1 ? height - 2 : y + 1)};
    const bool is_red_row = y % 2 == order.red_y;
    const int own_x = is_red_row ? order.red_x : 1 - order.red_x;
    const int begin = own_x == 0 ? 2 : 1;
    if (is_red_row) {
      FillRedRow(rows, begin, width, out.row(y));
    } else {
      FillBlueRow(rows, begin, width, out.row(y));
    }
    for (int x = 0; x < begin; ++x)
      FillPixel(rows, is_red_row, x % 2 == own_x, x, width, out.row(y));
    for (int x = width - 2; x < width; ++x) {
      FillPixel(rows, is_red_row, x % 2 == own_x, x, width, out.row(y));
    }
  }
}

}  // namespace mocap
