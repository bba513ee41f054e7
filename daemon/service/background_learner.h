// Learns the background while the cameras run.
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

/// The present background of each camera. Thread-safe.
class KnownBackgrounds {
 public:
  explicit KnownBackgrounds(std::vector<BackgroundSource> sources) : sources_(std::move(sources)) {}
  BackgroundSource Of(std::size_t camera) const;
  void Set(std::size_t camera, BackgroundSource source);

 private:
  mutable std::mutex mutex_;
  std::vector<BackgroundSource> sources_;
};

/// What learning works on, and where it stores the result.
struct LearningPlace {
  std::vector<CameraCalibration> cameras;
  std::filesystem::path folder;  ///< Stores the pictures for the next start.
  std::string refusal;           ///< Why learning is impossible here; empty: it is possible.
};

/// Observes the studio for some seconds and makes the frame path use the new background. No frame
/// is lost meanwhile. Learn: one thread at a time.
class BackgroundLearner {
 public:
  /// @param taps  one per camera, offered every frame; borrowed, like the path.
  BackgroundLearner(FramePath& path, std::deque<FrameTap>& taps, KnownBackgrounds& known,
                    LearningPlace place);

  /// Learns, stores and applies the background. @return  one line per camera.
  /// @param anyway  also while somebody is tracked: the "person" may be furniture.
  /// @throws std::runtime_error  if somebody moves in the room or is tracked, or a camera delivers
  /// nothing; SetupError if the studio has no background to learn. Then the old one stays.
  std::string Learn(bool anyway, double seconds = 4);
  /// Makes Learn give up, now and in future, because the daemon ends. Any thread.
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
