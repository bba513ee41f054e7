// Moments of a take in all its cameras, segmented and carved as in the daemon.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/silhouette/trimap.h"

namespace mocap {

/// One camera's picture at a moment.
struct SampledView {
  RigidTransform X_CW;
  Trimap trimap;
  Image<Bgr> image;  ///< Only if requested.
};

struct SampledMoment {
  std::int64_t timestamp_ns = 0;
  std::vector<std::optional<SampledView>>
      views;  ///< One for each camera; empty if it missed the frame.
  VoxelGrid voxels;
};

struct TakeSamples {
  std::vector<CameraCalibration> cameras;  ///< All calibrated cameras, those with frames first.
  std::vector<SampledMoment> moments;
  std::vector<std::string> remarks;  ///< On the take, for people.
};

/// A moment to sample.
struct SampleRequest {
  std::int64_t timestamp_ns = 0;
  bool keep_images = false;
};

/// Reads a take up to the last moment. For each camera, keeps the frame nearest to each moment,
/// within half a frame period.
/// @throws SetupError  as OpenTake and Segmenter.
TakeSamples SampleTake(const std::filesystem::path& take,
                       const std::vector<SampleRequest>& requests, double voxel_mm);

/// Returns the pose by calibration `now` at a moment when calibration `original` gave `sampled`. A
/// rotation in the camera's own frame does not depend on its head's angles.
inline RigidTransform PoseNow(const CameraCalibration& original, const CameraCalibration& now,
                              const RigidTransform& sampled) {
  return now.X_CW * original.X_CW.Inverse() * sampled;
}

}  // namespace mocap
