// Learns the background beside the cameras' work, while people move about.
#pragma once

#include <atomic>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "daemon/pipeline/frame_path.h"
#include "daemon/pipeline/tap.h"
#include "daemon/service/background_learner.h"

namespace mocap {

/// What is to be learned from people who move about.
struct OccupiedErrand {
  double seconds = 60;
  std::vector<std::string> accepted;  ///< Cameras whose moved things become part of the background.
};

/// Records the cameras for a while, learns the empty studio from it in a thread of low priority,
/// and makes the frame path use it. Tracking goes on meanwhile. Thread-safe.
class OccupiedLearner {
 public:
  /// Begins each line of Progress() while there is work to do.
  static constexpr const char* kUnderWay = "under way: ";

  /// @param taps  one per camera, offered every frame; borrowed, like the path. Nobody else uses
  /// them while this is under way.
  OccupiedLearner(FramePath& path, std::deque<FrameTap>& taps, KnownBackgrounds& known,
                  LearningPlace place);
  ~OccupiedLearner();

  /// Begins, and returns at once.
  /// @throws SetupError  if the studio has no background to learn, or a camera is not there;
  /// std::runtime_error if it is under way already.
  void Begin(const OccupiedErrand& errand);
  bool IsUnderWay() const { return is_under_way_.load(); }
  /// What it does at present, or what was learned, in lines. @throws  why nothing was learned.
  std::string Progress() const;
  /// The line of what it does at present; empty: nothing.
  std::string Present() const;
  /// Gives up, now and in future, because the daemon ends.
  void RequestStop() { stop_.store(true); }

 private:
  void Run(const OccupiedErrand& errand);
  void Record(const OccupiedErrand& errand, const std::filesystem::path& partial);
  std::string LearnAll(const OccupiedErrand& errand, const std::filesystem::path& partial);
  void Use();
  void Say(const std::string& text);
  void RequireGoing() const;

  FramePath& path_;
  std::deque<FrameTap>& taps_;
  KnownBackgrounds& known_;
  const LearningPlace place_;
  std::atomic<bool> stop_{false}, is_under_way_{false};
  mutable std::mutex mutex_;
  std::string text_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace mocap
