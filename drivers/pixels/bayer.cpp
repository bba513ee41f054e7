#include "drivers/pixels/bayer.h"

#include "core/errors.h"
#include "drivers/pixels/pixel_rows.h"

namespace mocap {
void InterpolateBayer(ImageView<const std::uint8_t> mosaic, BayerOrder order, Image<Bgr>& out) {
  const int width = mosaic.width(), height = mosaic.height();
  MOCAP_CHECK(width >= 2 && height >= 2 && out.width() == width && out.height() == height);
  for (int y = 0; y < height; ++y) {
    const MosaicRows rows{mosaic.row(y == 0 ? 1 : y - 1), mosaic.row(y),
                          mosaic.row(y == height - 1 ? height - 2 : y + 1)};
    const bool is_red_row = y % 2 == order.red_y;
    const int own_x = is_red_row ? order.red_x : 1 - order.red_x;
    const int begin = own_x == 0 ? 2 : 1;
    FillMosaicRow(rows, is_red_row, begin, width, out.row(y));
    const auto fill_at_edge = [&](int x) {
      const int left = x == 0 ? 1 : x - 1, right = x == width - 1 ? width - 2 : x + 1;
      out(x, y) = rows.PixelAt(left, x, right, is_red_row, x % 2 == own_x);
    };
    for (int x = 0; x < begin; ++x) fill_at_edge(x);
    for (int x = width - 2; x < width; ++x) fill_at_edge(x);
  }
}

}  // namespace mocap
