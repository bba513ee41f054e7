// Simulated pictures, painted before they are due.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "drivers/virtual_studio/scene.h"

namespace mocap::simulation {

/// Paints a camera's next picture while the last one is processed.
///
/// A real camera uses no processor time. A simulated one should not take it from those who process
/// its pictures either, so it paints in a thread of lowest priority. A caller that comes for a
/// picture still being painted gives that thread its own priority. Where this is not permitted, the
/// caller paints the picture itself. Only one thread may call it.
class PictureAhead {
 public:
  explicit PictureAhead(std::shared_ptr<const SceneView> view);
  ~PictureAhead();

  /// Requests the picture of a time, replacing one that is painted but not taken. Has no effect
  /// while another is being painted.
  void Ask(std::int64_t capture_ns);

  /// Exchanges the painter for the one that has painted that time, if any. Waits only for a picture
  /// being painted.
  /// @return  whether `painter` has changed.
  bool Take(std::int64_t capture_ns, std::unique_ptr<ScenePainter>& painter);

 private:
  enum class State : int { kIdle, kAsked, kPainted, kEnded };

  void Run();

  std::atomic<State> state_{State::kIdle};
  // Owned by the thread while a picture is requested.
  std::int64_t capture_ns_ = 0;
  std::unique_ptr<ScenePainter> painter_;
  std::thread thread_;
};

}  // namespace mocap::simulation
