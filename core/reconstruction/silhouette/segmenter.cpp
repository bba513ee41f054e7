#include "core/reconstruction/silhouette/segmenter.h"

#include <cmath>
#include <string>

#include "core/errors.h"
#include "core/reconstruction/background/displacement.h"
#include "core/reconstruction/silhouette/bit_filters.h"
#include "core/reconstruction/silhouette/coarse_scan.h"
#include "core/reconstruction/silhouette/outline_refiner.h"
#include "core/reconstruction/silhouette/pixel_classifier.h"
#include "core/reconstruction/silhouette/region_of_interest.h"
#include "core/reconstruction/silhouette/segmentation_constants.h"
#include "core/reconstruction/silhouette/silhouette_cleaner.h"
#include "core/reconstruction/silhouette/unseen_places.h"

namespace mocap {
namespace {

using namespace segmentation;

constexpr std::size_t kFewestFrames = 8;

void Check(const CameraCalibration& camera, std::span<const BackgroundFrame> background) {
  const std::string where = "background of camera " + camera.name + ": found ";
  if (background.size() < kFewestFrames)
    throw SetupError(where + std::to_string(background.size()) + " frames; expected at least " +
                     std::to_string(kFewestFrames));
  for (const BackgroundFrame& frame : background) {
    if (frame.image.width() == camera.width_px && frame.image.height() == camera.height_px)
      continue;
    throw SetupError(where + "a frame of " + std::to_string(frame.image.width()) + " x " +
                     std::to_string(frame.image.height()) + " px; expected " +
                     std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) +
                     " px as in the calibration");
  }
}

std::unique_ptr<BackgroundModel> Learn(const CameraCalibration& camera,
                                       std::span<const BackgroundFrame> background,
                                       double detection_rate) {
  Check(camera, background);
  return camera.head ? LearnPanTiltBackground(camera, background, detection_rate)
                     : LearnFixedBackground(background, detection_rate);
}

}  // namespace

class Segmenter::Impl {
 public:
  Impl(const CameraCalibration& camera, std::span<const BackgroundFrame> background,
       const SegmentationOptions& options)
      : background_(Learn(camera, background, options.detection_rate)),
        unseen_(background),
        coarse_(static_cast<float>(options.darkest_shadow)),
        classifier_(background_->thresholds(), static_cast<float>(options.darkest_shadow)),
        smallest_blob_px_(
            static_cast<int>(options.smallest_blob_share * camera.width_px * camera.height_px)),
        largest_thing_px_(
            static_cast<int>(options.largest_thing_share * camera.width_px * camera.height_px)) {}

  void Segment(ImageView<const Bgr> image, const PanTiltAngles& angles, Trimap& trimap) {
    Silhouette& silhouette = trimap.person;
    conditions_ = CoarsePass(image, angles);
    roi_.Set(coarse_.suspicious(), image.width(), image.height());
    const ExpectedPicture& expected = background_->Expect(roi_, conditions_);
    classifier_.Classify(expected, image, conditions_, roi_);
    silhouette = classifier_.foreground();
    cleaner_.Clean(kSmallestGap_px, LeaveUnseenOut(silhouette), smallest_blob_px_, silhouette);
    refiner_.Refine(expected, image, conditions_.gain, classifier_.alpha_shift(), silhouette);
    cleaner_.KeepPerson(kSmallestHole_px, smallest_blob_px_, largest_thing_px_, silhouette);
    silhouette.KeepBox();
    FindUnknown(trimap);
    MeasureShading(silhouette);
  }

  const Conditions& conditions() const { return conditions_; }
  const Shading& shading() const { return shading_; }

 private:
  // Clears pixels that were never seen empty. Returns what fills holes: these and the doubtful ones.
  const Silhouette& LeaveUnseenOut(Silhouette& person) {
    if (unseen_.empty()) return classifier_.doubtful();
    const Silhouette& unseen = unseen_.At(conditions_.displacement);
    Subtract(unseen, person);
    scratch_ = classifier_.doubtful();
    Unite(unseen, scratch_);
    return scratch_;
  }

  // What the empty studio rarely shows, what this and the person enclose, because clothes of the
  // wall's colour are seen by their outline only, and what may be a shadow. Thin rims are left out:
  // the refined outline runs there.
  void FindUnknown(Trimap& trimap) {
    scratch_ = classifier_.doubtful();
    Unite(trimap.person, scratch_);
    Dilate(scratch_, kRim_px, opened_);
    Erode(opened_, kRim_px, scratch_);
    scratch_.KeepBox();
    cleaner_.FillHoles(scratch_);
    Unite(classifier_.dark(), scratch_);
    Subtract(trimap.person, scratch_);
    Erode(scratch_, kRim_px, opened_);
    Dilate(opened_, kRim_px, trimap.unknown);
    Intersect(scratch_, trimap.unknown);
    if (!unseen_.empty()) {
      Unite(unseen_.At(conditions_.displacement), trimap.unknown);
      Subtract(trimap.person, trimap.unknown);
    }
    trimap.unknown.KeepBox();
  }

  void MeasureShading(const Silhouette& silhouette) {
    shading_.dark = classifier_.dark();
    Subtract(silhouette, shading_.dark);
    shading_.tile_columns = coarse_.live().tile_columns();
    shading_.shades = coarse_.shades();
    if (!unseen_.empty()) UnseenPlaces::LeaveOut(unseen_.At(conditions_.displacement), shading_);
    ListDarkTiles(classifier_.alpha_shift(), shading_);
  }

  // Compares the picture as a whole, and follows a camera that was nudged.
  Conditions CoarsePass(ImageView<const Bgr> image, const PanTiltAngles& angles) {
    const ExpectedHalf& expected = background_->CoarsePass(angles, {});
    coarse_.Compare(expected, image);
    const Conditions conditions = coarse_.conditions();
    if (conditions.shift_px == 0) return conditions;
    const auto displacement = MeasureDisplacement(coarse_.live(), conditions.gain[1], expected);
    if (!displacement || std::hypot(displacement->x_px, displacement->y_px) < kNudge_px)
      return conditions;
    const float shift_before_px = coarse_.shift_px();
    coarse_.Compare(background_->CoarsePass(angles, *displacement), image);
    if (coarse_.shift_px() < kMuchLess * shift_before_px) {
      Conditions displaced = coarse_.conditions();
      displaced.displacement = *displacement;
      return displaced;
    }
    coarse_.Compare(background_->CoarsePass(angles, {}), image);
    return conditions;
  }

  std::unique_ptr<BackgroundModel> background_;
  UnseenPlaces unseen_;
  CoarseScan coarse_;
  Conditions conditions_;
  RegionOfInterest roi_;
  PixelClassifier classifier_;
  SilhouetteCleaner cleaner_;
  OutlineRefiner refiner_;
  Shading shading_;
  Silhouette scratch_, opened_;
  int smallest_blob_px_, largest_thing_px_;
};

Segmenter::Segmenter(const CameraCalibration& camera, std::span<const BackgroundFrame> background,
                     const SegmentationOptions& options)
    : impl_(std::make_unique<Impl>(camera, background, options)) {}
Segmenter::Segmenter(Segmenter&&) noexcept = default;
Segmenter& Segmenter::operator=(Segmenter&&) noexcept = default;
Segmenter::~Segmenter() = default;

void Segmenter::Segment(ImageView<const Bgr> image, const PanTiltAngles& angles, Trimap& trimap) {
  impl_->Segment(image, angles, trimap);
}

const Shading& Segmenter::shading() const { return impl_->shading(); }
const Conditions& Segmenter::conditions() const { return impl_->conditions(); }

}  // namespace mocap
