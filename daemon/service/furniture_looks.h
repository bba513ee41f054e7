// Looks for furniture that is moved while the daemon runs.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/reconstruction/empty_room/furniture_watch.h"
#include "daemon/pipeline/frame_path.h"
#include "daemon/pipeline/tap.h"
#include "daemon/service/background_learner.h"
#include "daemon/status/moved_furniture.h"

namespace mocap {

/// Compares a picture of each fixed camera with its background, now and then, in a thread of low
/// priority. It ends with this object.
class FurnitureLooks {
 public:
  static constexpr std::chrono::milliseconds kInterval{2000};

  /// @param taps  one per camera, offered every frame; borrowed, like the path. Nobody else uses
  /// them.
  FurnitureLooks(const FramePath& path, std::deque<FrameTap>& taps, const KnownBackgrounds& known,
                 std::vector<CameraCalibration> cameras,
                 std::chrono::milliseconds interval = kInterval);
  ~FurnitureLooks();

  /// What stands there, by camera, the largest first. Any thread.
  std::vector<MovedFurniture> Moved() const;

 private:
  /// One camera's part.
  struct Camera {
    CameraCalibration calibration;
    std::optional<FurnitureWatch> watch = {};
    int replacements = -1;  ///< Identifies the background that it compares with.
    std::vector<MovedFurniture> moved = {};
  };

  void Run(std::chrono::milliseconds interval);
  void Look();
  void Compare(const TappedFrame& frame, const CameraStatus& status, std::size_t camera);

  const FramePath& path_;
  std::deque<FrameTap>& taps_;
  const KnownBackgrounds& known_;
  std::deque<Camera> cameras_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  std::vector<MovedFurniture> moved_;
  std::thread thread_;
};

}  // namespace mocap
