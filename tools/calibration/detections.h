// Detections of a board by all cameras, without the pictures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/board.h"
#include "tools/calibration/board_detector.h"
#include "tools/calibration/footage.h"

namespace mocap {

/// How a corner moves in the picture about the time of its frame.
struct CornerMotion {
  Vector2 velocity = Vector2::Zero();      ///< [px/s].
  Vector2 acceleration = Vector2::Zero();  ///< [px/s²].

  Vector2 After(double seconds) const {
    return velocity * seconds + acceleration * (seconds * seconds / 2);
  }
};

/// The board as one camera saw it at one moment.
struct BoardDetection {
  int camera = 0;
  int moment = 0;  ///< Boards of one moment are at one place.
  BoardCorners corners;
  PanTiltAngles angles;
  std::string name;   ///< Of the frame, for messages.
  double time_s = 0;  ///< Capture, from some common start.
  double late_s = 0;  ///< Capture after the moment's time.
  /// Motion of each corner in the picture, a parabola through the frames before and after; zero
  /// where those do not show it.
  std::vector<CornerMotion> motions;

  /// How far a corner moved in the picture from the moment's time to the exposure, when that is so
  /// much later than the time stamp.
  Vector2 MovedSince(std::size_t corner, double lateness_s) const {
    // The motion is told about the frame's own time.
    return motions.empty() ? Vector2(Vector2::Zero())
                           : -motions[corner].After(-(late_s + lateness_s));
  }
};

/// A camera of which nothing but its name and size need be known.
struct DetectionCamera {
  std::string name;
  int width_px = 0, height_px = 0;
  int frames = 0;  ///< Looked at.
};

struct BoardDetections {
  Board board;
  std::vector<DetectionCamera> cameras;
  int moments = 0;
  bool timed = false;     ///< Capture times are known.
  double interval_s = 1;  ///< The shortest between frames of a camera.
  std::vector<BoardDetection> detections;
  std::vector<Image<Bgr>> still_pictures;  ///< One a camera, where the board lies still.

  int CountOf(int camera) const;
};

struct DetectionOptions {
  Effort effort = Effort::kQuick;
  /// The board lies still: pictures of a camera are averaged into one moment, which takes noise
  /// away.
  bool still = false;
  /// Otherwise a camera may see nothing of the board.
  bool all_must_see = true;
  int most_frames = 400;  ///< A camera; a longer recording is thinned out evenly.
  /// Told about progress: camera, frames done and to do, views found, and where none was.
  std::function<void(const std::string&, int, int, int, const std::string&)> progress;
};

/// Looks for the board in all pictures.
/// @throws SetupError  when a camera sees no board at all, naming it and what to do.
BoardDetections CollectDetections(const Footage& footage, const Board& board,
                                  const DetectionOptions& options);

/// Matches timed detections anew into moments, once it is known how much later than its time stamps
/// each camera exposes.
void MatchAgain(const std::vector<double>& lateness_s, BoardDetections& detections);

/// Where in the picture corners were seen: shares of `kCoverageColumns` × `kCoverageRows` cells
/// that hold one.
struct Coverage {
  static constexpr int kColumns = 6, kRows = 4;
  int counts[kRows][kColumns] = {};
  double share = 0;
  /// "nothing in the upper left and at the right edge"; empty when all is covered.
  std::string Hint() const;
};

Coverage CoverageOf(const BoardDetections& detections, int camera);

}  // namespace mocap
