// Simulated pictures that are painted before they are due.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "drivers/simulation/scene.h"

namespace mocap::simulation {

/// Paints one camera's next picture while the last one is looked at.
///
/// A real camera costs no processor. Neither shall a simulated one take it from those who look at
/// its pictures: it paints in a thread that the kernel runs when nobody else wants to. Who comes
/// for a picture that is being painted lends that thread his place; where that is not permitted he
/// paints for himself. One thread asks and takes.
class PictureAhead {
 public:
  explicit PictureAhead(std::shared_ptr<const SceneView> view);
  ~PictureAhead();

  /// Asks for the picture of a moment, instead of one that was painted and not taken. While another
  /// is being painted that does nothing.
  void Ask(std::int64_t capture_ns);

  /// Gives a painter for the one that has painted that moment, if there is one. Waits for no more
  /// than what is left to paint.
  /// @return  whether `painter` has changed.
  bool Take(std::int64_t capture_ns, std::unique_ptr<ScenePainter>& painter);

 private:
  enum class State : int { kIdle, kAsked, kPainted, kEnded };

  void Run();

  std::atomic<State> state_{State::kIdle};
  // The thread's while something is asked for.
  std::int64_t capture_ns_ = 0;
  std::unique_ptr<ScenePainter> painter_;
  std::thread thread_;
};

}  // namespace mocap::simulation
