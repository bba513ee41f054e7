// Board detections of all cameras, without pictures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/board.h"
#include "tools/calibration/board_detector.h"
#include "tools/calibration/footage.h"

namespace mocap {

/// Motion of a corner in the picture at the time of its frame.
struct CornerMotion {
  Vector2 velocity = Vector2::Zero();      ///< [px/s].
  Vector2 acceleration = Vector2::Zero();  ///< [px/s²].

  Vector2 After(double seconds) const {
    return velocity * seconds + acceleration * (seconds * seconds / 2);
  }
};

/// Detection of the board by one camera at one moment.
struct BoardDetection {
  int camera = 0;
  int moment = 0;  ///< Boards of the same moment have the same pose.
  BoardCorners corners;
  PanTiltAngles angles;
  std::string name;   ///< Frame name, for messages.
  double time_s = 0;  ///< Capture time, from a common start.
  double late_s = 0;  ///< Capture time minus the moment's time.
  /// Motion of each corner in the picture, from a parabola through the neighbouring frames; zero if
  /// these do not show it.
  std::vector<CornerMotion> motions;

  /// Returns how far a corner moved in the picture from the moment's time to the exposure, if that
  /// is `lateness_s` after the timestamp.
  Vector2 MovedSince(std::size_t corner, double lateness_s) const {
    // The motion is relative to the frame's own time.
    return motions.empty() ? Vector2(Vector2::Zero())
                           : -motions[corner].After(-(late_s + lateness_s));
  }
};

/// A camera with name and size only.
struct DetectionCamera {
  std::string name;
  int width_px = 0, height_px = 0;
  int frames = 0;        ///< Number of frames searched.
  std::string mismatch;  ///< While no view is found: why, as of BoardDetector::WhyNot.
};

struct BoardDetections {
  Board board;  ///< With the layout that was found.
  std::vector<DetectionCamera> cameras;
  int moments = 0;
  bool timed = false;     ///< Capture times are known.
  double interval_s = 1;  ///< Shortest interval between frames of a camera.
  std::vector<BoardDetection> detections;
  std::vector<Image<Bgr>> still_pictures;  ///< One per camera, if the board lies still.

  int CountOf(int camera) const;
};

struct DetectionOptions {
  Effort effort = Effort::kQuick;
  /// The board lies still: averages each camera's pictures to one moment, to reduce noise.
  bool still = false;
  /// If false, cameras need not see the board.
  bool all_must_see = true;
  int most_frames = 400;  ///< Per camera; a longer recording is thinned out evenly.
  /// Progress callback: camera, frames done and to do, views found, and frames without a view.
  std::function<void(const std::string&, int, int, int, const std::string&)> progress;
};

/// Searches all pictures for the board.
/// @throws SetupError  when a camera sees no board at all, or another one, naming it and the
/// remedy.
BoardDetections CollectDetections(const Footage& footage, const Board& board,
                                  const DetectionOptions& options);

/// Matches timed detections to moments again, with known delays of the cameras' exposures after
/// their timestamps.
void MatchAgain(const std::vector<double>& lateness_s, BoardDetections& detections);

/// Coverage of the picture by corners: share of its `kColumns` × `kRows` cells that contain one.
struct Coverage {
  static constexpr int kColumns = 6, kRows = 4;
  int counts[kRows][kColumns] = {};
  double share = 0;
  /// "nothing in the upper left and at the right edge"; empty if everything is covered.
  std::string Hint() const;
};

Coverage CoverageOf(const BoardDetections& detections, int camera);

}  // namespace mocap
