#include "tools/gige/gige_pixels.h"

#include <algorithm>
#include <cstddef>

namespace mocap {
namespace {

// BT.601 in video range.
std::uint8_t Brightness(const Bgr& p) {
  return static_cast<std::uint8_t>(16 + ((66 * p.r + 129 * p.g + 25 * p.b + 128) >> 8));
}
std::uint8_t Blueness(int r, int g, int b) {
  return static_cast<std::uint8_t>(128 + ((-38 * r - 74 * g + 112 * b + 128) >> 8));
}
std::uint8_t Redness(int r, int g, int b) {
  return static_cast<std::uint8_t>(128 + ((112 * r - 94 * g - 18 * b + 128) >> 8));
}

/// Sample behind a pixel's colour filter; red is at (red_x, red_y) of each two by two pixels.
std::uint8_t Filtered(const Bgr& p, int x, int y, int red_x, int red_y) {
  if (x % 2 == red_x && y % 2 == red_y) return p.r;
  if (x % 2 != red_x && y % 2 != red_y) return p.b;
  return p.g;
}

template <typename Write>
void ForEachPixel(ImageView<const Bgr> picture, Write write) {
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) write(picture(x, y), x, y);
  }
}

void EncodeBayer(ImageView<const Bgr> picture, int red_x, int red_y, std::uint8_t* out) {
  ForEachPixel(picture,
               [&](const Bgr& p, int x, int y) { *out++ = Filtered(p, x, y, red_x, red_y); });
}

void EncodeYuv(ImageView<const Bgr> picture, int brightness_at, std::uint8_t* out) {
  const int colour_at = 1 - brightness_at;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x + 1 < picture.width(); x += 2, out += 4) {
      const Bgr &p = picture(x, y), &q = picture(x + 1, y);
      const int r = (p.r + q.r) / 2, g = (p.g + q.g) / 2, b = (p.b + q.b) / 2;
      out[brightness_at] = Brightness(p);
      out[brightness_at + 2] = Brightness(q);
      out[colour_at] = Blueness(r, g, b);
      out[colour_at + 2] = Redness(r, g, b);
    }
  }
}

}  // namespace

void EncodePicture(ImageView<const Bgr> picture, ArvPixelFormat format,
                   std::span<std::uint8_t> out) {
  const std::size_t pixels = static_cast<std::size_t>(picture.width()) * picture.height();
  std::uint8_t* to = out.data();
  const std::size_t needed = pixels * ARV_PIXEL_FORMAT_BIT_PER_PIXEL(format) / 8;
  if (out.size() < needed) {
    std::ranges::fill(out, std::uint8_t{0});
    return;
  }
  switch (format) {
    case ARV_PIXEL_FORMAT_MONO_8:
      ForEachPixel(picture, [&](const Bgr& p, int, int) {
        *to++ = static_cast<std::uint8_t>((77 * p.r + 150 * p.g + 29 * p.b + 128) >> 8);
      });
      return;
    case ARV_PIXEL_FORMAT_BGR_8_PACKED:
      for (int y = 0; y < picture.height(); ++y, to += 3 * picture.width()) {
        std::copy_n(&picture.row(y)->b, 3 * picture.width(), to);
      }
      return;
    case ARV_PIXEL_FORMAT_RGB_8_PACKED:
      ForEachPixel(picture, [&](const Bgr& p, int, int) {
        *to++ = p.r;
        *to++ = p.g;
        *to++ = p.b;
      });
      return;
    case ARV_PIXEL_FORMAT_BAYER_RG_8:
      return EncodeBayer(picture, 0, 0, to);
    case ARV_PIXEL_FORMAT_BAYER_GR_8:
      return EncodeBayer(picture, 1, 0, to);
    case ARV_PIXEL_FORMAT_BAYER_GB_8:
      return EncodeBayer(picture, 0, 1, to);
    case ARV_PIXEL_FORMAT_BAYER_BG_8:
      return EncodeBayer(picture, 1, 1, to);
    case ARV_PIXEL_FORMAT_YUV_422_YUYV_PACKED:
      return EncodeYuv(picture, 0, to);
    case ARV_PIXEL_FORMAT_YUV_422_PACKED:
      return EncodeYuv(picture, 1, to);
    default:
      std::ranges::fill(out, std::uint8_t{0});
  }
}

}  // namespace mocap
