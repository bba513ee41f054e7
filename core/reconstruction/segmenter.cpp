#include "core/reconstruction/segmenter.h"

#include <string>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/background_model.h"
#include "core/reconstruction/silhouette_cleaner.h"

namespace mocap {
namespace {

constexpr std::size_t kFewestFrames = 8;

std::vector<const Image<Bgr>*> Checked(const CameraCalibration& camera,
                                       std::span<const BackgroundFrame> background) {
  if (background.size() < kFewestFrames)
    throw SetupError("background of camera " + camera.name + ": found " +
                     std::to_string(background.size()) + " frames, wanted at least " +
                     std::to_string(kFewestFrames));
  std::vector<const Image<Bgr>*> frames;
  for (const BackgroundFrame& frame : background) {
    if (frame.image.width() != camera.width_px || frame.image.height() != camera.height_px)
      throw SetupError("background of camera " + camera.name + ": found frames of " +
                       std::to_string(frame.image.width()) + " x " +
                       std::to_string(frame.image.height()) + " px, wanted " +
                       std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) +
                       " as in the calibration");
    frames.push_back(&frame.image);
  }
  return frames;
}

}  // namespace

class Segmenter::Impl {
 public:
  Impl(const CameraCalibration& camera, std::span<const BackgroundFrame> background,
       const SegmentationOptions& options)
      : model_(Checked(camera, background), options.detection_rate),
        classes_(camera.width_px, camera.height_px),
        cleaner_(options.smallest_blob_share) {}

  void Segment(ImageView<const Bgr> image, const PanTiltAngles&, Silhouette& silhouette) {
    model_.Classify(image, classes_);
    silhouette.Reset(classes_.width(), classes_.height());
    for (int y = 0; y < classes_.height(); ++y)
      for (int x = 0; x < classes_.width(); ++x)
        if (classes_(x, y) >= static_cast<std::uint8_t>(PixelClass::kHighlight))
          silhouette.Set(x, y);
    cleaner_.Clean(silhouette);
  }

 private:
  BackgroundModel model_;
  Image<std::uint8_t> classes_;
  SilhouetteCleaner cleaner_;
};

Segmenter::Segmenter(const CameraCalibration& camera, std::span<const BackgroundFrame> background,
                     const SegmentationOptions& options)
    : impl_(std::make_unique<Impl>(camera, background, options)) {}
Segmenter::Segmenter(Segmenter&&) noexcept = default;
Segmenter& Segmenter::operator=(Segmenter&&) noexcept = default;
Segmenter::~Segmenter() = default;

void Segmenter::Segment(ImageView<const Bgr> image, const PanTiltAngles& angles,
                        Silhouette& silhouette) {
  impl_->Segment(image, angles, silhouette);
}

}  // namespace mocap
