// Pictures of any moment of a take.
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/floor_shadows.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_reader.h"

namespace mocap {

/// One camera's picture of a moment. The pixels are valid until the next request.
struct TakePicture {
  int camera = 0;
  std::int64_t capture_ns = 0;
  RigidTransform X_CW;
  ImageView<const Bgr> image;
  std::optional<Trimap> trimap;  ///< Once the background has been learned.
};

/// Reads any moment of a take, in any order. Learns the background meanwhile, in separate threads.
/// Single-threaded.
class TakePictures {
 public:
  /// @throws SetupError  as OpenTake.
  explicit TakePictures(const std::filesystem::path& take);

  const std::string& name() const { return name_; }
  double fps_nominal() const { return fps_nominal_; }
  const std::vector<CameraCalibration>& cameras() const { return calibrations_; }
  /// On the take, for people.
  const std::vector<std::string>& remarks() const { return remarks_; }
  /// Pose of each camera in its first frame.
  std::vector<RigidTransform> FirstPoses() const;
  /// Frame times of the camera with most frames [ns].
  std::vector<std::int64_t> Times() const;

  /// Pictures of all cameras that have a frame within half a period of a time. Trimaps are those
  /// that are carved: the floor is decided from all cameras' views.
  std::vector<TakePicture> At(std::int64_t time_ns);
  /// Returns the share of unknown pixels where a picture shows a hull of the same moment.
  std::optional<double> UnknownShareOf(const TakePicture& picture, const VoxelGrid& hull) const;
  /// Carves the pictures' trimaps; empty while one is missing.
  VoxelGrid Carve(const std::vector<TakePicture>& pictures);

 private:
  struct Camera {
    VideoReader video;
    TakeTable table;
    std::future<Segmenter> learning;
    std::optional<Segmenter> segmenter;
    std::size_t next = 0;  ///< Row of the video's next frame.
    ImageView<const Bgr> image;
    bool is_whole = false;  ///< The frame of row next - 1 was decoded.
  };

  bool Seek(Camera& camera, std::size_t row) const;
  void DecideFloor(std::vector<TakePicture>& pictures);
  std::optional<Trimap> Segment(Camera& camera, const PanTiltAngles& angles) const;

  std::string name_;
  std::vector<std::string> remarks_;
  double fps_nominal_ = 0;
  std::vector<CameraCalibration> calibrations_;
  std::vector<Camera> cameras_;
  std::vector<SensorPlaneTable> tables_;
  std::optional<FloorShadows> shadows_;
  Carver carver_;
};

}  // namespace mocap
