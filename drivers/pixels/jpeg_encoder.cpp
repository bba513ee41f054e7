#include "drivers/pixels/jpeg_encoder.h"

#include <turbojpeg.h>

#include "core/errors.h"

namespace mocap {

JpegEncoder::JpegEncoder() : encoder_(tjInitCompress(), tjDestroy) { MOCAP_CHECK(encoder_); }

void JpegEncoder::Encode(ImageView<const Bgr> image, int quality, std::vector<std::uint8_t>& jpeg) {
  jpeg.resize(tjBufSize(image.width(), image.height(), TJSAMP_420));
  unsigned char* bytes = jpeg.data();
  unsigned long size = jpeg.size();
  const auto* pixels = reinterpret_cast<const unsigned char*>(image.row(0));
  const int row_bytes = static_cast<int>(image.stride()) * static_cast<int>(sizeof(Bgr));
  const int failed = tjCompress2(encoder_.get(), pixels, image.width(), row_bytes, image.height(),
                                 TJPF_BGR, &bytes, &size, TJSAMP_420, quality, TJFLAG_NOREALLOC);
  MOCAP_CHECK(failed == 0);
  jpeg.resize(size);
}

}  // namespace mocap
