// Small JPEG pictures for viewers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/image.h"

namespace mocap {

/// Encodes JPEGs with libjpeg-turbo. Only one thread may use it at a time.
class JpegEncoder {
 public:
  JpegEncoder();

  /// @param quality  1 to 100.
  /// @param jpeg     overwritten; its memory is reused.
  void Encode(ImageView<const Bgr> image, int quality, std::vector<std::uint8_t>& jpeg);

 private:
  std::unique_ptr<void, int (*)(void*)> encoder_;
};

}  // namespace mocap
