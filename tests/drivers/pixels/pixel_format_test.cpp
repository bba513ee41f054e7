#include "drivers/pixels/pixel_format.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cstdlib>
#include <vector>

#include "drivers/pixels/bayer.h"
#include "tests/support/images.h"

namespace mocap {
namespace {

constexpr int kWidth = 22, kHeight = 14;  // Not a multiple of what vector code likes.

using Bytes = std::vector<std::uint8_t>;

RawPicture Picture(PixelFormat format, const Bytes& bytes, std::size_t stride = 0) {
  return {format, kWidth, kHeight, stride, bytes};
}

Image<Bgr> Converted(const RawPicture& picture) {
  PixelConverter converter;
  Image<Bgr> out;
  EXPECT_TRUE(converter.Convert(picture, out));
  return out;
}

void ExpectNear(const Bgr& found, const Bgr& wanted, int tolerance) {
  EXPECT_LE(std::abs(found.b - wanted.b), tolerance);
  EXPECT_LE(std::abs(found.g - wanted.g), tolerance);
  EXPECT_LE(std::abs(found.r - wanted.r), tolerance);
}

/// A colour that changes slowly over the picture; what a camera would have seen.
Bgr Seen(int x, int y) {
  return {static_cast<std::uint8_t>(60 + 4 * x), static_cast<std::uint8_t>(200 - 5 * y),
          static_cast<std::uint8_t>(90 + 3 * x + 2 * y)};
}

struct Yuv {
  std::uint8_t y, u, v;
};

/// BT.601 in video range, from its definition.
Yuv YuvOf(const Bgr& c) {
  const double y = 0.299 * c.r + 0.587 * c.g + 0.114 * c.b;
  const auto rounded = [](double value) { return static_cast<std::uint8_t>(value + 0.5); };
  return {rounded(16 + 219.0 / 255 * y), rounded(128 + 224.0 / 255 * (c.b - y) / 1.772),
          rounded(128 + 224.0 / 255 * (c.r - y) / 1.402)};
}

/// Both pixels of a pair have the colour of the left one, as the format cannot tell them apart.
Bgr SeenInPairs(int x, int y) { return Seen(x / 2 * 2, y); }

Bytes Packed(PixelFormat format, std::size_t stride) {
  Bytes bytes(stride * kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; x += 2) {
      const Yuv c = YuvOf(SeenInPairs(x, y));
      std::uint8_t* out = &bytes[y * stride + 2 * x];
      if (format == PixelFormat::kYuyv) {
        out[0] = out[2] = c.y, out[1] = c.u, out[3] = c.v;
      } else {
        out[1] = out[3] = c.y, out[0] = c.u, out[2] = c.v;
      }
    }
  }
  return bytes;
}

TEST(PixelConverter, YuyvAndUyvyGiveTheColoursThatWereSeen) {
  for (const PixelFormat format : {PixelFormat::kYuyv, PixelFormat::kUyvy}) {
    for (const std::size_t stride : {2 * kWidth, 2 * kWidth + 20}) {
      const Bytes bytes = Packed(format, stride);
      const Image<Bgr> out = Converted(Picture(format, bytes, stride));
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) ExpectNear(out(x, y), SeenInPairs(x, y), 3);
      }
    }
  }
}

TEST(PixelConverter, Nv12TakesOneColourForFourPixels) {
  Bytes bytes;
  const auto seen = [](int x, int y) { return Seen(x / 2 * 2, y / 2 * 2); };
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) bytes.push_back(YuvOf(seen(x, y)).y);
  }
  for (int y = 0; y < kHeight; y += 2) {
    for (int x = 0; x < kWidth; x += 2) {
      bytes.push_back(YuvOf(seen(x, y)).u);
      bytes.push_back(YuvOf(seen(x, y)).v);
    }
  }
  const Image<Bgr> out = Converted(Picture(PixelFormat::kNv12, bytes));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) ExpectNear(out(x, y), seen(x, y), 3);
  }
}

TEST(PixelConverter, VideoRangeEndsAtBlackAndWhite) {
  const Bytes dark(2 * kWidth * kHeight, 0), bright(2 * kWidth * kHeight, 255);
  Bytes grey(dark.size());
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = i % 2 == 0 ? 16 : 128;
  EXPECT_EQ(Converted(Picture(PixelFormat::kYuyv, grey))(3, 3), (Bgr{0, 0, 0}));
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = i % 2 == 0 ? 235 : 128;
  EXPECT_EQ(Converted(Picture(PixelFormat::kYuyv, grey))(3, 3), (Bgr{255, 255, 255}));
  // Beyond the range nothing wraps around.
  EXPECT_EQ(Converted(Picture(PixelFormat::kYuyv, dark))(3, 3).r, 0);
  EXPECT_EQ(Converted(Picture(PixelFormat::kYuyv, bright))(3, 3).b, 255);
}

TEST(PixelConverter, RgbBgrAndGreyKeepTheirNumbers) {
  Bytes rgb, bgr, grey;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Bgr c = Seen(x, y);
      rgb.insert(rgb.end(), {c.r, c.g, c.b});
      bgr.insert(bgr.end(), {c.b, c.g, c.r});
      grey.push_back(c.g);
    }
  }
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Bgr c = Seen(x, y);
      EXPECT_EQ(Converted(Picture(PixelFormat::kRgb, rgb))(x, y), c);
      EXPECT_EQ(Converted(Picture(PixelFormat::kBgr, bgr))(x, y), c);
      EXPECT_EQ(Converted(Picture(PixelFormat::kGrey, grey))(x, y), (Bgr{c.g, c.g, c.g}));
    }
  }
}

/// The name says where red is: at (x, y) of each 2 × 2 pixels.
struct NamedOrder {
  PixelFormat format;
  int red_x, red_y;
};

TEST(PixelConverter, EveryBayerOrderGivesTheColoursThatWereSeen) {
  for (const NamedOrder order : {NamedOrder{PixelFormat::kBayerRggb, 0, 0},
                                 {PixelFormat::kBayerGrbg, 1, 0},
                                 {PixelFormat::kBayerGbrg, 0, 1},
                                 {PixelFormat::kBayerBggr, 1, 1}}) {
    Bytes bytes;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const Bgr c = Seen(x, y);
        const bool red_column = x % 2 == order.red_x, red_row = y % 2 == order.red_y;
        bytes.push_back(red_column == red_row ? (red_row ? c.r : c.b) : c.g);
      }
    }
    const Image<Bgr> out = Converted(Picture(order.format, bytes));
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        // A linear change is interpolated exactly but for rounding; at the border half a step is
        // lost to mirroring.
        const bool border = x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1;
        ExpectNear(out(x, y), Seen(x, y), border ? 6 : 1);
      }
    }
  }
}

TEST(PixelConverter, TooFewBytesAreADamagedPicture) {
  PixelConverter converter;
  Image<Bgr> out;
  for (const PixelFormat format :
       {PixelFormat::kYuyv, PixelFormat::kUyvy, PixelFormat::kNv12, PixelFormat::kGrey,
        PixelFormat::kRgb, PixelFormat::kBgr, PixelFormat::kBayerBggr}) {
    RawPicture picture = Picture(format, {});
    const Bytes bytes(LeastBytes(picture));
    picture.bytes = bytes;
    EXPECT_TRUE(converter.Convert(picture, out));
    picture.bytes = picture.bytes.first(bytes.size() - 1);
    EXPECT_FALSE(converter.Convert(picture, out));
  }
}

TEST(PixelConverter, RowsThatOverlapAreADamagedPicture) {
  PixelConverter converter;
  Image<Bgr> out;
  for (const PixelFormat format :
       {PixelFormat::kYuyv, PixelFormat::kNv12, PixelFormat::kGrey, PixelFormat::kBgr}) {
    RawPicture picture = Picture(format, {});
    const Bytes bytes(LeastBytes(picture));
    picture.bytes = bytes;
    picture.stride_bytes = LeastRowBytes(format, picture.width_px) - 1;
    EXPECT_FALSE(converter.Convert(picture, out));
  }
}

class Jpeg : public ::testing::Test {
 protected:
  Jpeg() {
    Image<Bgr> image(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) image(x, y) = Seen(x, y);
    }
    const tjhandle handle = tjInitCompress();
    unsigned char* jpeg = nullptr;
    unsigned long size = 0;
    tjCompress2(handle, &image.row(0)->b, kWidth, 0, kHeight, TJPF_BGR, &jpeg, &size, TJSAMP_422,
                95, 0);
    bytes_.assign(jpeg, jpeg + size);
    tjFree(jpeg);
    tjDestroy(handle);
  }

  bool Converts(const Bytes& bytes) {
    return converter_.Convert(Picture(PixelFormat::kMjpeg, bytes), out_);
  }

  Bytes bytes_;
  PixelConverter converter_;
  Image<Bgr> out_;
};

TEST_F(Jpeg, GivesTheColoursThatWereSeen) {
  ASSERT_TRUE(Converts(bytes_));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) ExpectNear(out_(x, y), Seen(x, y), 12);
  }
}

TEST_F(Jpeg, CutOffOrGarbledIsADamagedPicture) {
  EXPECT_FALSE(Converts({}));
  EXPECT_FALSE(Converts(Bytes(bytes_.begin(), bytes_.begin() + 40)));
  EXPECT_FALSE(Converts(Bytes(bytes_.begin(), bytes_.end() - 30)));
  EXPECT_FALSE(Converts(Bytes(500, 0xa5)));
  // The next one is read as if nothing had been.
  EXPECT_TRUE(Converts(bytes_));
}

TEST_F(Jpeg, OfAnotherSizeIsADamagedPicture) {
  RawPicture picture{PixelFormat::kMjpeg, kWidth + 2, kHeight, 0, bytes_};
  EXPECT_FALSE(converter_.Convert(picture, out_));
}

TEST_F(Jpeg, FilledUpAtItsEndIsWhole) {
  Bytes filled = bytes_;
  filled.insert(filled.end() - 2, 7, 0x00);
  filled.insert(filled.end(), 64, 0x00);
  EXPECT_TRUE(Converts(filled));
}

}  // namespace
}  // namespace mocap
