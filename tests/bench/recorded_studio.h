// A simulated walk, rendered before anything is measured.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "drivers/studio.h"

namespace mocap::bench {

struct StudioSize {
  int cameras = 6;
  int width_px = 640, height_px = 480;
};

/// Frames of all cameras in memory, and what they become.
class RecordedStudio {
 public:
  static constexpr int kSets = 20;
  static constexpr double kFps = 30;

  /// Renders what has not been rendered yet; kept until the program ends.
  static const RecordedStudio& Get(const StudioSize& size);

  const StudioSize& size() const { return size_; }
  const std::vector<CameraCalibration>& cameras() const { return cameras_; }
  const std::vector<BackgroundFrame>& background(int camera) const { return background_[camera]; }
  ImageView<const Bgr> frame(int camera, int set) const { return frames_[camera][set].view(); }
  const Trimap& trimap(int camera, int set) const { return trimaps_[camera][set]; }
  /// The set that comes so late, where the walk goes to its end and back again.
  static int SetAt(int index) {
    constexpr int kPeriod = 2 * (kSets - 1);
    return std::min(index % kPeriod, kPeriod - index % kPeriod);
  }
  /// The silhouettes of a set, to carve.
  std::vector<CarvingView> Views(int set) const;

  enum class Pace { kAsTaken, kLive };  ///< Frames come as soon as they are taken, or at kFps.

  /// Opens the recording as a source of so many sets.
  Studio Open(int sets, Pace pace = Pace::kAsTaken) const;

 private:
  explicit RecordedStudio(const StudioSize& size);

  StudioSize size_;
  std::vector<CameraCalibration> cameras_;
  std::vector<SensorPlaneTable> tables_;
  std::vector<std::vector<BackgroundFrame>> background_;
  std::vector<std::vector<Image<Bgr>>> frames_;
  std::vector<std::vector<Trimap>> trimaps_;
};

}  // namespace mocap::bench
