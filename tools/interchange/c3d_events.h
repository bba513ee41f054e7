// The events of a C3D file: start and end of tracking, and steps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/interchange/c3d_layout.h"
#include "tools/results/result.h"

namespace mocap {

/// Times of captured frames in a file of constant frame rate.
struct C3dClock {
  std::vector<std::int64_t> capture_ns;  ///< Increasing.
  std::vector<double> file_s;

  /// Returns the time in the file of a time between two frames.
  double At(double moment_ns) const;
};

/// Collects the events of the subjects.
class C3dEvents {
 public:
  explicit C3dEvents(std::vector<std::string> subjects);

  /// Notes whether a subject is tracked in a frame. Times increase.
  void Note(std::size_t subject, bool is_tracked, double time_s);
  /// Notes when a subject's feet strike the floor and leave it.
  void NoteSteps(std::size_t subject, const Result& result, const C3dClock& clock);
  /// Returns all in order of time.
  std::vector<C3dEvent> Take();

 private:
  void AddGeneral(const char* label, std::size_t subject, double time_s);

  std::vector<std::string> subjects_;
  std::vector<double> last_s_;  ///< Time of the last frame if tracked in it; else -1.
  std::vector<C3dEvent> events_;
};

}  // namespace mocap
