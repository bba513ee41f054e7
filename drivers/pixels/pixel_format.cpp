#include "drivers/pixels/pixel_format.h"

#include <turbojpeg.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "drivers/pixels/bayer.h"
#include "drivers/pixels/pixel_rows.h"

namespace mocap {

/// A row of pixels as three planes of luma and chroma, one byte per pixel each.
struct YuvRow {
  explicit YuvRow(int width) : y(width + 1), u(width + 1), v(width + 1) {}
  std::vector<std::uint8_t> y, u, v;
};

namespace {

std::size_t StrideOf(const RawPicture& picture) {
  return picture.stride_bytes > 0 ? picture.stride_bytes
                                  : LeastRowBytes(picture.format, picture.width_px);
}

std::uint8_t* Bytes(Bgr* row) { return &row->b; }

void ConvertPacked(const RawPicture& picture, YuvRow& row, Image<Bgr>& out) {
  const int width = picture.width_px, pairs = (width + 1) / 2;
  const auto unpack = picture.format == PixelFormat::kYuyv ? UnpackYuyv : UnpackUyvy;
  for (int y = 0; y < picture.height_px; ++y) {
    unpack(picture.bytes.data() + y * StrideOf(picture), pairs, row.y.data(), row.u.data(),
           row.v.data());
    ToBgr(row.y.data(), row.u.data(), row.v.data(), width, Bytes(out.row(y)));
  }
}

void ConvertNv12(const RawPicture& picture, YuvRow& row, Image<Bgr>& out) {
  const int width = picture.width_px;
  const std::size_t stride = StrideOf(picture);
  const std::uint8_t* colours = picture.bytes.data() + stride * picture.height_px;
  for (int y = 0; y < picture.height_px; ++y) {
    if (y % 2 == 0) {
      UnpackPairs(colours + y / 2 * stride, (width + 1) / 2, row.u.data(), row.v.data());
    }
    ToBgr(picture.bytes.data() + y * stride, row.u.data(), row.v.data(), width, Bytes(out.row(y)));
  }
}

void ConvertInterleaved(const RawPicture& picture, Image<Bgr>& out) {
  const bool is_rgb = picture.format == PixelFormat::kRgb;
  for (int y = 0; y < picture.height_px; ++y) {
    const std::uint8_t* in = picture.bytes.data() + y * StrideOf(picture);
    if (!is_rgb) {
      std::copy_n(in, 3 * picture.width_px, Bytes(out.row(y)));
      continue;
    }
    for (int x = 0; x < picture.width_px; ++x, in += 3) out(x, y) = {in[2], in[1], in[0]};
  }
}

void ConvertGrey(const RawPicture& picture, Image<Bgr>& out) {
  for (int y = 0; y < picture.height_px; ++y) {
    const std::uint8_t* in = picture.bytes.data() + y * StrideOf(picture);
    for (int x = 0; x < picture.width_px; ++x) out(x, y) = {in[x], in[x], in[x]};
  }
}

BayerOrder OrderOf(PixelFormat format) {
  switch (format) {
    case PixelFormat::kBayerGrbg:
      return {1, 0};
    case PixelFormat::kBayerGbrg:
      return {0, 1};
    case PixelFormat::kBayerBggr:
      return {1, 1};
    default:
      return {0, 0};
  }
}

/// Some cameras pad the end of their JPEGs. All other TurboJPEG warnings mean wrong pixels.
bool IsHarmlessWarning(std::string_view warning) {
  return warning.find("extraneous bytes before marker 0xd9") != std::string_view::npos;
}

}  // namespace

std::size_t LeastRowBytes(PixelFormat format, int width_px) {
  const auto width = static_cast<std::size_t>(width_px);
  switch (format) {
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
      return (width + 1) / 2 * 4;
    case PixelFormat::kNv12:
      return (width + 1) / 2 * 2;
    case PixelFormat::kRgb:
    case PixelFormat::kBgr:
      return width * 3;
    case PixelFormat::kMjpeg:
      return 0;
    default:
      return width;
  }
}

std::size_t LeastBytes(const RawPicture& picture) {
  if (picture.format == PixelFormat::kMjpeg) return 1;
  const auto height = static_cast<std::size_t>(picture.height_px);
  const std::size_t rows =
      picture.format == PixelFormat::kNv12 ? height + (height + 1) / 2 : height;
  // The last row may lack its padding.
  return (rows - 1) * StrideOf(picture) + LeastRowBytes(picture.format, picture.width_px);
}

double TypicalBytesPerPixel(PixelFormat format) {
  constexpr double kJpeg = 0.25;
  switch (format) {
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
      return 2;
    case PixelFormat::kNv12:
      return 1.5;
    case PixelFormat::kRgb:
    case PixelFormat::kBgr:
      return 3;
    case PixelFormat::kMjpeg:
      return kJpeg;
    default:
      return 1;
  }
}

class PixelConverter::Impl {
 public:
  ~Impl() {
    if (jpeg_) tjDestroy(jpeg_);
  }

  bool Convert(const RawPicture& picture, Image<Bgr>& out) {
    MOCAP_CHECK(picture.width_px >= 2 && picture.height_px >= 2);
    // The stride that a driver reports may be wrong.
    if (StrideOf(picture) < LeastRowBytes(picture.format, picture.width_px)) return false;
    if (picture.bytes.size() < LeastBytes(picture)) return false;
    if (out.width() != picture.width_px || out.height() != picture.height_px) {
      out = Image<Bgr>(picture.width_px, picture.height_px);
    }
    switch (picture.format) {
      case PixelFormat::kYuyv:
      case PixelFormat::kUyvy:
        ConvertPacked(picture, RowFor(picture.width_px), out);
        return true;
      case PixelFormat::kNv12:
        ConvertNv12(picture, RowFor(picture.width_px), out);
        return true;
      case PixelFormat::kGrey:
        ConvertGrey(picture, out);
        return true;
      case PixelFormat::kRgb:
      case PixelFormat::kBgr:
        ConvertInterleaved(picture, out);
        return true;
      case PixelFormat::kMjpeg:
        return Decode(picture, out);
      default:
        InterpolateBayer({picture.bytes.data(), picture.width_px, picture.height_px,
                          static_cast<std::ptrdiff_t>(StrideOf(picture))},
                         OrderOf(picture.format), out);
        return true;
    }
  }

 private:
  YuvRow& RowFor(int width) {
    if (static_cast<int>(row_.y.size()) != width + 1) row_ = YuvRow(width);
    return row_;
  }

  bool Decode(const RawPicture& picture, Image<Bgr>& out) {
    if (!jpeg_) jpeg_ = tjInitDecompress();
    MOCAP_CHECK(jpeg_);
    int width = 0, height = 0, subsampling = 0, colours = 0;
    const auto* bytes = picture.bytes.data();
    const auto size = static_cast<unsigned long>(picture.bytes.size());
    if (tjDecompressHeader3(jpeg_, bytes, size, &width, &height, &subsampling, &colours) != 0 ||
        width != picture.width_px || height != picture.height_px) {
      return false;
    }
    if (tjDecompress2(jpeg_, bytes, size, Bytes(out.row(0)), width, 3 * width, height, TJPF_BGR,
                      0) == 0) {
      return true;
    }
    return tjGetErrorCode(jpeg_) == TJERR_WARNING && IsHarmlessWarning(tjGetErrorStr2(jpeg_));
  }

  YuvRow row_{0};
  tjhandle jpeg_ = nullptr;
};

PixelConverter::PixelConverter() : impl_(std::make_unique<Impl>()) {}
PixelConverter::~PixelConverter() = default;
PixelConverter::PixelConverter(PixelConverter&&) noexcept = default;
PixelConverter& PixelConverter::operator=(PixelConverter&&) noexcept = default;

bool PixelConverter::Convert(const RawPicture& picture, Image<Bgr>& out) {
  return impl_->Convert(picture, out);
}

}  // namespace mocap
