#include "drivers/take/mask_video.h"

#include <cstdint>

#include "core/errors.h"
#include "drivers/take/video_reader.h"
#include "drivers/take/video_writer.h"

namespace mocap {
namespace {

constexpr std::uint8_t kDarkestWhite = 128;
/// Of one mask; nobody plays it.
constexpr double kMaskFps = 1;

}  // namespace

void TakeWhite(ImageView<const Bgr> mask, Silhouette& silhouette) {
  silhouette.Reset(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y) {
    const Bgr* const row = mask.row(y);
    std::uint64_t* const words = silhouette.row(y);
    for (int x = 0; x < mask.width(); ++x) {
      words[x / 64] |= std::uint64_t{row[x].g >= kDarkestWhite} << x % 64;
    }
  }
  silhouette.KeepBox();
}

void WriteMask(const std::filesystem::path& file, const Silhouette& silhouette) {
  Image<std::uint8_t> mask(silhouette.width(), silhouette.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) mask(x, y) = silhouette.Test(x, y) ? 255 : 0;
  }
  VideoWriter video(file, mask.width(), mask.height(), kMaskFps, VideoPixels::kGray);
  video.Write(mask.view());
  video.Finish();
}

Silhouette ReadMask(const std::filesystem::path& file) {
  VideoReader video(file);
  ImageView<const Bgr> mask;
  if (video.Read(mask) != VideoStatus::kFrame)
    throw SetupError(file.string() + ": has no picture; expected a mask");
  Silhouette silhouette;
  TakeWhite(mask, silhouette);
  return silhouette;
}

}  // namespace mocap
