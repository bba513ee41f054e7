// Any moment of a take, as its cameras saw it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_reader.h"

namespace mocap {

/// One camera's picture of a moment. The pixels stay valid until the next one is asked for.
struct TakePicture {
  int camera = 0;
  std::int64_t capture_ns = 0;
  RigidTransform X_CW;
  ImageView<const Bgr> image;
  std::optional<Silhouette> silhouette;  ///< Once the empty studio has been learned.
};

/// Reads a take at any moment, in any order; going on is faster than going back. The empty studio
/// is learned meanwhile, in threads of its own. One thread.
class TakePictures {
 public:
  /// @throws SetupError  as OpenTake.
  explicit TakePictures(const std::filesystem::path& take);

  const std::string& name() const { return name_; }
  double fps_nominal() const { return fps_nominal_; }
  const std::vector<CameraCalibration>& cameras() const { return calibrations_; }
  /// Where each camera stands in its first frame.
  std::vector<RigidTransform> FirstPoses() const;
  /// Times of the frames of the camera that has most [ns].
  std::vector<std::int64_t> Times() const;

  /// The picture of each camera that has a frame within half a period of a moment.
  std::vector<TakePicture> At(std::int64_t time_ns);
  /// What these silhouettes carve; no voxels while one is still missing.
  VoxelGrid Carve(const std::vector<TakePicture>& pictures);

 private:
  struct Camera {
    VideoReader video;
    TakeTable table;
    std::future<Segmenter> learning;
    std::optional<Segmenter> segmenter;
    std::size_t next = 0;  ///< The row whose frame the video gives next.
    ImageView<const Bgr> image;
    bool is_whole = false;  ///< The frame of row next - 1 could be decoded.
  };

  bool Seek(Camera& camera, std::size_t row) const;
  std::optional<Silhouette> Segment(Camera& camera, const PanTiltAngles& angles) const;

  std::string name_;
  double fps_nominal_ = 0;
  std::vector<CameraCalibration> calibrations_;
  std::vector<Camera> cameras_;
  std::vector<SensorPlaneTable> tables_;
  Carver carver_;
};

}  // namespace mocap
