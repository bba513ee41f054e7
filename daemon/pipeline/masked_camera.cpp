#include "daemon/pipeline/masked_camera.h"

#include <chrono>
#include <map>
#include <string>
#include <utility>

#include "drivers/clock.h"
#include "drivers/take/mask_video.h"

namespace mocap {
namespace {

/// Limits the time that a stop can take.
constexpr std::chrono::milliseconds kMaskTimeout{100};

/// The shading of a picture in which every place has its usual brightness.
void SetUnshaded(int width, int height, Shading& shading) {
  const auto tiles = [](int pixels) {
    return (pixels + Shading::kTile_px - 1) / Shading::kTile_px;
  };
  shading.dark.Reset(width, height);
  shading.dark_tiles.clear();
  shading.tile_columns = tiles(width);
  shading.shades.assign(static_cast<std::size_t>(tiles(width)) * tiles(height), 0);
}

}  // namespace

MaskedCamera::MaskedCamera(const CameraCalibration& calibration,
                           std::unique_ptr<CameraDriver> masks, int rays)
    : calibration_(calibration), masks_(std::move(masks)), rays_(rays) {
  MOCAP_CHECK(masks_ != nullptr);
}

void MaskedCamera::Stop() {
  masks_->Stop();
  counters_.Enter(CameraState::kEnded);
}

SilhouetteSource::Outcome MaskedCamera::Next(const std::atomic<std::int64_t>& wanted_from_ns,
                                             SegmentedFrame& out) {
  if (expectation() == Expectation::kCertain) counters_.Expect(Expectation::kPossible);
  Frame mask;
  const GrabStatus grabbed = masks_->Grab(mask, kMaskTimeout);
  if (grabbed == GrabStatus::kEnd) return Outcome::kEnd;
  if (grabbed == GrabStatus::kTorn) counters_.CountTorn();
  if (grabbed != GrabStatus::kFrame) return Outcome::kNothing;
  counters_.Enter(CameraState::kStreaming);
  counters_.CountFrame(mask.sequence);
  if (!counters_.IsWanted(mask.capture_ns, wanted_from_ns)) {
    counters_.CountDropped();
    return Outcome::kNothing;
  }
  counters_.Expect(Expectation::kCertain);
  out.arrival_ns = TimelineNs();
  out.capture_ns = mask.capture_ns;
  out.sequence = mask.sequence;
  out.angles = mask.angles;
  out.X_CW = calibration_.PoseAt(mask.angles);
  const std::int64_t begin_ns = SteadyNs();
  TakeWhite(mask.image, out.trimap.person);
  out.trimap.unknown.Reset(mask.image.width(), mask.image.height());
  out.trimap.unknown.KeepBox();
  SetUnshaded(mask.image.width(), mask.image.height(), out.shading);
  TraceOutline(calibration_, out.X_CW, out.trimap, rays_, out.outline);
  out.segment_ns = SteadyNs() - begin_ns;
  counters_.Note(out);
  return Outcome::kFrame;
}

CameraStatus MaskedCamera::Status() const {
  CameraStatus status;
  status.name = calibration_.name;
  counters_.Fill(status);
  return status;
}

OpenElsewhere TakeMaskedCameras(Studio& studio) {
  const auto drivers = std::make_shared<std::map<std::string, std::unique_ptr<CameraDriver>>>();
  for (StudioCamera& camera : studio.cameras) {
    drivers->emplace(camera.calibration.name, std::move(camera.driver));
  }
  return [drivers](const CameraCalibration& camera, int rays) {
    return std::make_unique<MaskedCamera>(camera, std::move(drivers->at(camera.name)), rays);
  };
}

}  // namespace mocap
