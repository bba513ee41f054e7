// Learns what the empty studio looks like while the cameras run.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "daemon/pipeline/frame_path.h"
#include "daemon/pipeline/tap.h"
#include "drivers/background_source.h"

namespace mocap {

/// Each camera's knowledge of the empty studio. Thread-safe.
class KnownBackgrounds {
 public:
  explicit KnownBackgrounds(std::vector<BackgroundSource> sources) : sources_(std::move(sources)) {}
  BackgroundSource Of(std::size_t camera) const;
  void Set(std::size_t camera, BackgroundSource source);

 private:
  mutable std::mutex mutex_;
  std::vector<BackgroundSource> sources_;
};

/// Where it is learned, and for whom.
struct LearningPlace {
  std::vector<CameraCalibration> cameras;
  std::filesystem::path folder;  ///< Keeps the pictures for the next start.
  std::string refusal;           ///< Why nothing can be learned here; empty: it can.
};

/// Looks at the studio for some seconds and has the frame path go on with what was seen; no frame
/// is lost meanwhile. Learn: one thread at a time.
class BackgroundLearner {
 public:
  /// @param taps  one a camera, offered every frame; borrowed, as is the path.
  BackgroundLearner(FramePath& path, std::deque<FrameTap>& taps, KnownBackgrounds& known,
                    LearningPlace place);

  /// Learns, keeps and uses what the cameras see. @return  one line a camera.
  /// @param anyway  also while somebody is tracked: what is taken for a person may be furniture.
  /// @throws std::runtime_error  when somebody moves in the room or is tracked, or a camera
  /// delivers nothing; SetupError when the studio has nothing to learn. What was known holds then.
  std::string Learn(bool anyway, double seconds = 4);
  /// Has Learn give up, now and from now on: the daemon ends. Any thread.
  void RequestStop() { stop_.store(true); }

 private:
  struct Look;

  std::deque<Look> LookAround(double seconds);
  void RequireEmptyRoom(const std::deque<Look>& looks) const;
  void RequireNobody() const;
  void Keep(const std::deque<Look>& looks) const;
  void Use(const std::deque<Look>& looks);

  FramePath& path_;
  std::deque<FrameTap>& taps_;
  KnownBackgrounds& known_;
  const LearningPlace place_;
  std::atomic<bool> stop_{false};
};

}  // namespace mocap
