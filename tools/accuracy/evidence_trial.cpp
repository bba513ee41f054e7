#include "tools/accuracy/evidence_trial.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <utility>

#include "core/errors.h"
#include "core/reconstruction/carving/carver.h"
#include "daemon/pipeline/pose_sink.h"
#include "tools/accuracy/accuracy_trial.h"

namespace mocap {
namespace {

Silhouette SilhouetteOfMask(ImageView<const std::uint8_t> mask) {
  Silhouette silhouette(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) != 0) silhouette.Set(x, y);
    }
  }
  return silhouette;
}

// Keeps the true mask of every frame of a simulated camera.
class MaskKeeper : public CameraDriver {
 public:
  MaskKeeper(std::unique_ptr<CameraDriver> camera, std::vector<Silhouette>& masks)
      : camera_(std::move(camera)), masks_(masks) {}

  void Start() override { camera_->Start(); }
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override {
    const GrabStatus status = camera_->Grab(frame, timeout);
    if (status == GrabStatus::kFrame) {
      auto* const simulated = dynamic_cast<SimulatedCamera*>(camera_.get());
      MOCAP_CHECK(simulated);
      masks_.push_back(SilhouetteOfMask(simulated->TrueMask()));
    }
    return status;
  }
  void Stop() override { camera_->Stop(); }

 private:
  const std::unique_ptr<CameraDriver> camera_;
  std::vector<Silhouette>& masks_;
};

std::int64_t CountVoxels(const VoxelGrid& grid) {
  std::int64_t count = 0;
  for (const std::uint64_t word : grid.words()) count += std::popcount(word);
  return count;
}

class VolumeKeeper : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override {
    frames.push_back(static_cast<std::size_t>(set.frame));
    voxels += CountVoxels(set.grid);
  }

  std::vector<std::size_t> frames;
  std::int64_t voxels = 0;
};

// @param masks  by camera, then by frame.
std::int64_t TrueVoxels(const std::vector<CameraCalibration>& cameras,
                        const std::vector<std::vector<Silhouette>>& masks,
                        const std::vector<std::size_t>& frames, double voxel_mm) {
  std::deque<SensorPlaneTable> tables;
  for (const CameraCalibration& camera : cameras) tables.emplace_back(camera);
  Carver carver({.voxel_mm = voxel_mm});
  VoxelGrid grid;
  std::int64_t voxels = 0;
  for (const std::size_t frame : frames) {
    std::vector<CarvingView> views;
    for (std::size_t c = 0; c < cameras.size(); ++c)
      views.push_back({&tables[c], &masks[c].at(frame), cameras[c].X_CW});
    carver.Carve(views, grid);
    voxels += CountVoxels(grid);
  }
  return voxels;
}

}  // namespace

std::vector<EvidenceKind> PlannedEvidence() {
  std::vector<EvidenceKind> kinds;
  for (const double contrast : kEvidenceContrasts) {
    for (const std::optional<int>& crf : kEvidenceCrfs) {
      for (const int cameras : kEvidenceCameras)
        kinds.push_back({.contrast = contrast, .crf = crf, .cameras = cameras});
    }
  }
  return kinds;
}

void ApplyEvidence(const EvidenceKind& kind, SimulatedStudioOptions& studio) {
  studio.contrast = kind.contrast;
  studio.crf = kind.crf;
  studio.cameras = kind.cameras;
}

EvidenceRow RunEvidenceTrial(const SimulatedStudioOptions& options) {
  AccuracyTrial trial;
  trial.studio = options;
  Studio studio = OpenSimulatedStudio(options);
  std::vector<CameraCalibration> cameras;
  std::vector<std::vector<Silhouette>> masks(studio.cameras.size());
  for (std::size_t c = 0; c < studio.cameras.size(); ++c) {
    StudioCamera& camera = studio.cameras[c];
    cameras.push_back(camera.calibration);
    camera.driver = std::make_unique<MaskKeeper>(std::move(camera.driver), masks[c]);
  }
  VolumeKeeper volumes;
  const TrialOutcome outcome = TrackStudio(trial, std::move(studio), volumes);
  const std::int64_t true_voxels = TrueVoxels(cameras, masks, volumes.frames, trial.voxel_mm);
  return {.kind = {options.contrast, options.crf, options.cameras},
          .accuracy = RowOf(trial, outcome),
          .hull_share = static_cast<double>(volumes.voxels) /
                        static_cast<double>(std::max<std::int64_t>(1, true_voxels))};
}

}  // namespace mocap
