#include "tools/accuracy/evidence_trial.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/errors.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/floor_shadows.h"
#include "core/reconstruction/carving/unknown_share.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "daemon/pipeline/pose_sink.h"
#include "drivers/simulation/simulated_studio.h"
#include "tools/accuracy/accuracy_trial.h"

namespace mocap {
namespace {

// Unknown pixels change little from frame to frame.
constexpr std::size_t kFramesPerTrimap = 10;

// What one camera saw.
struct CameraSight {
  std::vector<Silhouette> masks;  // The true ones, of every frame.
  std::vector<Trimap> trimaps;    // Of the first frame, and of each kFramesPerTrimap later.
  std::vector<Shading> shadings;  // Likewise.
};

// Keeps what a simulated camera saw.
class SightKeeper : public CameraDriver {
 public:
  SightKeeper(std::unique_ptr<CameraDriver> camera, Segmenter segmenter, CameraSight& sight)
      : camera_(std::move(camera)), segmenter_(std::move(segmenter)), sight_(sight) {}

  void Start() override { camera_->Start(); }
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override {
    const GrabStatus status = camera_->Grab(frame, timeout);
    if (status == GrabStatus::kFrame) {
      auto* const simulated = dynamic_cast<SimulatedCamera*>(camera_.get());
      MOCAP_CHECK(simulated);
      if (sight_.masks.size() % kFramesPerTrimap == 0) {
        segmenter_.Segment(frame.image, frame.angles, sight_.trimaps.emplace_back());
        sight_.shadings.push_back(segmenter_.shading());
      }
      sight_.masks.push_back(simulated->TrueSilhouette());
    }
    return status;
  }
  void Stop() override { camera_->Stop(); }

 private:
  const std::unique_ptr<CameraDriver> camera_;
  Segmenter segmenter_;
  CameraSight& sight_;
};

class VolumeKeeper : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override {
    frames.push_back(static_cast<std::size_t>(set.frame));
    voxels += set.grid.Count();
    if (frames.back() % kFramesPerTrimap == 0) hulls[frames.back()] = set.grid;
  }

  std::vector<std::size_t> frames;
  std::int64_t voxels = 0;
  std::map<std::size_t, VoxelGrid> hulls;  // Of the frames that have trimaps.
};

std::int64_t TrueVoxels(const std::vector<CameraCalibration>& cameras,
                        const std::deque<CameraSight>& sights,
                        const std::vector<std::size_t>& frames, double voxel_mm) {
  std::deque<SensorPlaneTable> tables;
  for (const CameraCalibration& camera : cameras) tables.emplace_back(camera);
  Carver carver({.voxel_mm = voxel_mm});
  VoxelGrid grid;
  std::int64_t voxels = 0;
  for (const std::size_t frame : frames) {
    std::vector<CarvingView> views;
    for (std::size_t c = 0; c < cameras.size(); ++c)
      views.push_back({&tables[c], &sights[c].masks.at(frame), cameras[c].X_CW});
    carver.Carve(views, grid);
    voxels += grid.Count();
  }
  return voxels;
}

// The mean over cameras and frames, as carving knows them; 0 if nobody is ever seen.
double MeanUnknownShareOf(const std::vector<CameraCalibration>& cameras,
                          std::deque<CameraSight>& sights,
                          const std::map<std::size_t, VoxelGrid>& hulls) {
  const std::vector<SensorPlaneTable> tables(cameras.begin(), cameras.end());
  FloorShadows shadows(cameras);
  double sum = 0;
  int count = 0;
  for (const auto& [frame, hull] : hulls) {
    std::vector<ShadedView> views;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      views.push_back({static_cast<int>(c), &tables[c], cameras[c].X_CW,
                       &sights[c].shadings.at(frame / kFramesPerTrimap),
                       &sights[c].trimaps.at(frame / kFramesPerTrimap)});
    }
    shadows.Complete(views);
    for (const ShadedView& view : views) {
      const std::optional<double> share =
          UnknownShare(hull, {view.table, &view.trimap->person, view.X_CW, &view.trimap->unknown});
      sum += share.value_or(0);
      count += share.has_value();
    }
  }
  return sum / std::max(1, count);
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
  for (const int cameras : kEvidenceCameras)
    kinds.push_back({.cameras = cameras, .soft_shadows = true});
  for (const int cameras : kEvidenceCameras)
    kinds.push_back({.cameras = cameras, .misled_share = kEvidenceMisled});
  return kinds;
}

void ApplyEvidence(const EvidenceKind& kind, SimulatedStudioOptions& studio) {
  studio.contrast = kind.contrast;
  studio.crf = kind.crf;
  studio.cameras = kind.cameras;
  studio.misled_share = kind.misled_share;
  studio.soft_shadows = kind.soft_shadows;
}

EvidenceRow RunEvidenceTrial(const SimulatedStudioOptions& options) {
  AccuracyTrial trial;
  trial.studio = options;
  Studio studio = OpenSimulatedStudio(options);
  std::vector<CameraCalibration> cameras;
  std::deque<CameraSight> sights(studio.cameras.size());
  for (std::size_t c = 0; c < studio.cameras.size(); ++c) {
    StudioCamera& camera = studio.cameras[c];
    cameras.push_back(camera.calibration);
    Segmenter segmenter(camera.calibration, camera.background(), SegmentationOptions{});
    camera.driver =
        std::make_unique<SightKeeper>(std::move(camera.driver), std::move(segmenter), sights[c]);
  }
  VolumeKeeper volumes;
  const TrialOutcome outcome = TrackStudio(trial, std::move(studio), volumes);
  const std::int64_t true_voxels = TrueVoxels(cameras, sights, volumes.frames, trial.voxel_mm);
  return {.kind = {options.contrast, options.crf, options.cameras, options.misled_share,
                   options.soft_shadows},
          .accuracy = RowOf(trial, outcome),
          .hull_share = static_cast<double>(volumes.voxels) /
                        static_cast<double>(std::max<std::int64_t>(1, true_voxels)),
          .unknown_share = MeanUnknownShareOf(cameras, sights, volumes.hulls)};
}

}  // namespace mocap
