// GenICam pixel formats that the driver supports.
#pragma once

#include <arv.h>

#include <array>
#include <optional>

#include "drivers/pixels/pixel_format.h"

namespace mocap {

struct AravisFormat {
  const char* name;  ///< GenICam name since 2013.
  ArvPixelFormat code;
  PixelFormat format;
};

/// In order of preference: colour with low bandwidth first.
inline constexpr std::array<AravisFormat, 9> kAravisFormats = {
    {{"BayerRG8", ARV_PIXEL_FORMAT_BAYER_RG_8, PixelFormat::kBayerRggb},
     {"BayerGR8", ARV_PIXEL_FORMAT_BAYER_GR_8, PixelFormat::kBayerGrbg},
     {"BayerGB8", ARV_PIXEL_FORMAT_BAYER_GB_8, PixelFormat::kBayerGbrg},
     {"BayerBG8", ARV_PIXEL_FORMAT_BAYER_BG_8, PixelFormat::kBayerBggr},
     {"YUV422_8", ARV_PIXEL_FORMAT_YUV_422_YUYV_PACKED, PixelFormat::kYuyv},
     {"YUV422_8_UYVY", ARV_PIXEL_FORMAT_YUV_422_PACKED, PixelFormat::kUyvy},
     {"BGR8", ARV_PIXEL_FORMAT_BGR_8_PACKED, PixelFormat::kBgr},
     {"RGB8", ARV_PIXEL_FORMAT_RGB_8_PACKED, PixelFormat::kRgb},
     {"Mono8", ARV_PIXEL_FORMAT_MONO_8, PixelFormat::kGrey}}};

inline std::optional<AravisFormat> FindAravisFormat(ArvPixelFormat code) {
  for (const AravisFormat& format : kAravisFormats) {
    if (format.code == code) return format;
  }
  return std::nullopt;
}

}  // namespace mocap
