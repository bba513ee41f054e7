// Some moments of a take as all its cameras saw them, segmented and carved as the daemon does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// One camera's picture at a moment.
struct SampledView {
  RigidTransform X_CW;
  Silhouette silhouette;
  Image<Bgr> image;  ///< Only where it was asked for.
};

struct SampledMoment {
  std::int64_t timestamp_ns = 0;
  std::vector<std::optional<SampledView>>
      views;  ///< One a camera; empty where it missed the frame.
  VoxelGrid voxels;
};

struct TakeSamples {
  std::vector<CameraCalibration> cameras;  ///< All that are calibrated, those with frames first.
  std::vector<SampledMoment> moments;
};

/// A moment to sample.
struct SampleRequest {
  std::int64_t timestamp_ns = 0;
  bool keep_images = false;
};

/// Reads a take up to the last moment and keeps, for each camera, the frame nearest to each moment
/// and no farther than half a frame's time.
/// @throws SetupError  as OpenTake and Segmenter.
TakeSamples SampleTake(const std::filesystem::path& take,
                       const std::vector<SampleRequest>& requests, double voxel_mm);

}  // namespace mocap
