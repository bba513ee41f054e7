// Subject position, passed from tracking to the heads that follow.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/geometry.h"

namespace mocap {

/// The middle of the subject, or of all subjects. One writer, any number of readers; wait-free.
class SubjectPosition {
 public:
  /// @param p_WQ  [mm], within 32 m of the world's origin; empty while nobody is tracked.
  void Tell(const std::optional<Vector3>& p_WQ) {
    Place place;
    if (p_WQ) place = {true, Rounded(p_WQ->x()), Rounded(p_WQ->y()), Rounded(p_WQ->z())};
    place_.store(place, std::memory_order_relaxed);
  }

  std::optional<Vector3> Told() const {
    const Place place = place_.load(std::memory_order_relaxed);
    if (!place.is_known) return std::nullopt;
    return Vector3(place.x_mm, place.y_mm, place.z_mm);
  }

 private:
  /// One word, so that reads and writes are atomic.
  struct alignas(8) Place {
    std::int16_t is_known = 0;
    std::int16_t x_mm = 0, y_mm = 0, z_mm = 0;
  };

  static std::int16_t Rounded(double mm) {
    constexpr double kFarthest_mm = 32000;
    return static_cast<std::int16_t>(std::lround(std::clamp(mm, -kFarthest_mm, kFarthest_mm)));
  }

  std::atomic<Place> place_{Place{}};
  static_assert(std::atomic<Place>::is_always_lock_free);
};

}  // namespace mocap
