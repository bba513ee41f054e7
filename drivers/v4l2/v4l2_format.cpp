#include "drivers/v4l2/v4l2_format.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "core/errors.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

struct KnownFormat {
  std::uint32_t fourcc;
  PixelFormat pixels;
};

/// In order of preference: webcams' best formats first, raw before compressed, colour before grey.
constexpr std::array<KnownFormat, 12> kKnownFormats{{
    {V4L2_PIX_FMT_YUYV, PixelFormat::kYuyv},
    {V4L2_PIX_FMT_UYVY, PixelFormat::kUyvy},
    {V4L2_PIX_FMT_NV12, PixelFormat::kNv12},
    {V4L2_PIX_FMT_BGR24, PixelFormat::kBgr},
    {V4L2_PIX_FMT_RGB24, PixelFormat::kRgb},
    {V4L2_PIX_FMT_SRGGB8, PixelFormat::kBayerRggb},
    {V4L2_PIX_FMT_SGRBG8, PixelFormat::kBayerGrbg},
    {V4L2_PIX_FMT_SGBRG8, PixelFormat::kBayerGbrg},
    {V4L2_PIX_FMT_SBGGR8, PixelFormat::kBayerBggr},
    {V4L2_PIX_FMT_MJPEG, PixelFormat::kMjpeg},
    {V4L2_PIX_FMT_JPEG, PixelFormat::kMjpeg},
    {V4L2_PIX_FMT_GREY, PixelFormat::kGrey},
}};

/// Rates within this tolerance count as the requested one.
constexpr double kRateTolerance = 0.02;
/// More sizes than any camera has.
constexpr std::uint32_t kMostEntries = 200;

std::string NameOf(std::uint32_t fourcc) {
  std::string name;
  for (int i = 0; i < 4; ++i) name += static_cast<char>(fourcc >> (8 * i) & 0x7f);
  return Printable(name);
}

std::string Shown(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::vector<std::uint32_t> OfferedFormats(VideoKernel& kernel, int handle) {
  std::vector<std::uint32_t> formats;
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  while (format.index < kMostEntries && kernel.Request(handle, VIDIOC_ENUM_FMT, &format) == 0) {
    formats.push_back(format.pixelformat);
    ++format.index;
  }
  return formats;
}

struct Size {
  int width, height;
};

std::vector<Size> OfferedSizes(VideoKernel& kernel, int handle, std::uint32_t fourcc) {
  std::vector<Size> sizes;
  v4l2_frmsizeenum size{};
  size.pixel_format = fourcc;
  while (size.index < kMostEntries && kernel.Request(handle, VIDIOC_ENUM_FRAMESIZES, &size) == 0) {
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      return {
          {static_cast<int>(size.stepwise.max_width), static_cast<int>(size.stepwise.max_height)}};
    }
    sizes.push_back(
        {static_cast<int>(size.discrete.width), static_cast<int>(size.discrete.height)});
    ++size.index;
  }
  return sizes;
}

double RateOf(const v4l2_fract& interval) {
  return interval.numerator == 0 ? 0 : 1.0 * interval.denominator / interval.numerator;
}

/// Returns the highest frame rate at a size; empty: no such size. A camera that reports no rates is
/// assumed to keep any.
std::optional<double> FastestRate(VideoKernel& kernel, int handle, std::uint32_t fourcc, Size at) {
  v4l2_frmivalenum interval{};
  interval.pixel_format = fourcc;
  interval.width = static_cast<std::uint32_t>(at.width);
  interval.height = static_cast<std::uint32_t>(at.height);
  double fastest = 0;
  int result = 0;
  while (interval.index < kMostEntries &&
         (result = kernel.Request(handle, VIDIOC_ENUM_FRAMEINTERVALS, &interval)) == 0) {
    const bool is_one = interval.type == V4L2_FRMIVAL_TYPE_DISCRETE;
    fastest = std::max(fastest, RateOf(is_one ? interval.discrete : interval.stepwise.min));
    if (!is_one) break;
    ++interval.index;
  }
  if (interval.index == 0 && result == -ENOTTY) return std::numeric_limits<double>::infinity();
  if (fastest > 0) return fastest;
  const std::vector<Size> sizes = OfferedSizes(kernel, handle, fourcc);
  const bool offered = sizes.empty() || std::ranges::any_of(sizes, [&](const Size& size) {
                         return size.width == at.width && size.height == at.height;
                       });
  return offered ? std::optional(std::numeric_limits<double>::infinity()) : std::nullopt;
}

std::string Offers(VideoKernel& kernel, int handle) {
  std::string text;
  for (const std::string& line : DescribeFormats(kernel, handle)) {
    if (!text.empty()) text += "; ";
    text += line;
  }
  return text;
}

v4l2_format CurrentFormat(VideoKernel& kernel, int handle) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  kernel.Request(handle, VIDIOC_G_FMT, &format);
  return format;
}

/// @throws SetupError  when no format is suitable.
KnownFormat Choose(VideoKernel& kernel, int handle, const std::string& where, Size size, double fps,
                   const std::string& wanted) {
  const std::vector<std::uint32_t> offered = OfferedFormats(kernel, handle);
  std::optional<KnownFormat> best;
  double best_rate = 0;
  for (const KnownFormat& known : kKnownFormats) {
    if (std::ranges::find(offered, known.fourcc) == offered.end()) continue;
    if (!wanted.empty() && NameOf(known.fourcc) != wanted) continue;
    const auto rate = FastestRate(kernel, handle, known.fourcc, size);
    if (!rate) continue;
    // All formats that keep the rate are equally good.
    const double useful = std::min(*rate, fps * (1 - kRateTolerance));
    if (best && useful <= best_rate) continue;
    best = known;
    best_rate = useful;
  }
  if (best) return *best;
  throw SetupError(where + ": has no " + (wanted.empty() ? "supported format" : wanted) + " at " +
                   SizeText(size.width, size.height) + "; it offers " + Offers(kernel, handle));
}

double SetRate(VideoKernel& kernel, int handle, double fps) {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  parameters.parm.capture.timeperframe = {1000,
                                          static_cast<std::uint32_t>(std::lround(1000 * fps))};
  if (kernel.Request(handle, VIDIOC_S_PARM, &parameters) < 0) return 0;
  parameters = {};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (kernel.Request(handle, VIDIOC_G_PARM, &parameters) < 0) return 0;
  return RateOf(parameters.parm.capture.timeperframe);
}

void RemarkOnRate(VideoKernel& kernel, int handle, const KnownFormat& format, Size size,
                  double asked, double got, std::vector<std::string>& remarks) {
  if (got <= 0 || std::abs(got - asked) <= kRateTolerance * asked) return;
  std::string remark = "fps: requested " + Shown(asked) + ", the camera set " + Shown(got);
  const auto fastest = FastestRate(kernel, handle, format.fourcc, size);
  if (fastest && std::isfinite(*fastest) && *fastest < asked) {
    remark += "; " + NameOf(format.fourcc) + " at " + SizeText(size.width, size.height) +
              " has at most " + Shown(*fastest) + ": set fps = " + Shown(*fastest) +
              ", or another format or size_px";
  }
  remarks.push_back(remark);
}

}  // namespace

std::vector<std::string> DescribeFormats(VideoKernel& kernel, int handle) {
  std::vector<std::string> lines;
  for (const std::uint32_t fourcc : OfferedFormats(kernel, handle)) {
    std::string line = NameOf(fourcc);
    const bool known = std::ranges::any_of(
        kKnownFormats, [&](const KnownFormat& format) { return format.fourcc == fourcc; });
    if (!known) continue;
    for (const Size& size : OfferedSizes(kernel, handle, fourcc)) {
      line += ' ';
      line += SizeText(size.width, size.height);
      const auto rate = FastestRate(kernel, handle, fourcc, size);
      if (rate && std::isfinite(*rate)) line.append("@").append(Shown(*rate));
    }
    lines.push_back(line);
  }
  return lines;
}

/// The bytes from row to row; 0 if the driver reports none or an impossible value.
std::size_t StrideOf(const KnownFormat& format, const Size& size, std::uint32_t told,
                     std::vector<std::string>& remarks) {
  if (format.pixels == PixelFormat::kMjpeg) return 0;
  const std::size_t least = LeastRowBytes(format.pixels, size.width);
  if (told == 0 || told >= least) return told;
  remarks.push_back("its driver reports rows of " + std::to_string(told) + " bytes, but " +
                    std::to_string(least) + " are needed; rows are read without gaps");
  return 0;
}

V4l2Format SetFormat(VideoKernel& kernel, int handle, const std::string& where,
                     const CameraRequest& request, const std::string& wanted,
                     std::vector<std::string>& remarks) {
  v4l2_format format = CurrentFormat(kernel, handle);
  v4l2_pix_format& pixels = format.fmt.pix;
  const Size size = request.width_px > 0
                        ? Size{request.width_px, request.height_px}
                        : Size{static_cast<int>(pixels.width), static_cast<int>(pixels.height)};
  const KnownFormat chosen = Choose(kernel, handle, where, size, request.fps, wanted);
  format = {};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  pixels.width = static_cast<std::uint32_t>(size.width);
  pixels.height = static_cast<std::uint32_t>(size.height);
  pixels.pixelformat = chosen.fourcc;
  pixels.field = V4L2_FIELD_NONE;
  const int result = kernel.Request(handle, VIDIOC_S_FMT, &format);
  if (result == -EBUSY) {
    throw SetupError(where + ": is in use by another program; `fuser` shows which");
  }
  const Size got{static_cast<int>(pixels.width), static_cast<int>(pixels.height)};
  if (result < 0 || got.width != size.width || got.height != size.height ||
      pixels.pixelformat != chosen.fourcc) {
    throw SetupError(where + ": delivers " + NameOf(pixels.pixelformat) + " " +
                     SizeText(got.width, got.height) + " instead of " + NameOf(chosen.fourcc) +
                     " " + SizeText(size.width, size.height) + "; it offers " +
                     Offers(kernel, handle));
  }
  V4l2Format set{NameOf(chosen.fourcc), chosen.pixels, got.width, got.height, 0, 0};
  set.stride_bytes = StrideOf(chosen, got, pixels.bytesperline, remarks);
  set.fps = SetRate(kernel, handle, request.fps);
  RemarkOnRate(kernel, handle, chosen, size, request.fps, set.fps, remarks);
  return set;
}

}  // namespace mocap
