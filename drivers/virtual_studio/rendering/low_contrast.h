// Clothes that hardly differ from what is behind them.
#pragma once

#include "core/image.h"

namespace mocap::simulation {

/// Colours clothes after the picture of the empty room; reuses its memory. Thread-bound.
class LowContrast {
 public:
  /// @param grey_values  the largest difference of a colour's values.
  explicit LowContrast(double grey_values) : grey_values_(static_cast<float>(grey_values)) {}

  /// Prepares for pictures before this view of the empty room.
  void SetView(const Image<Bgr>& empty);
  /// Colours a pixel of clothes. Their texture is their own: the room's is smoothed. Where the
  /// room's differs by more than is allowed, as beside edges, it shows.
  /// @param empty  the same pixel without people.
  /// @param shade  from 0.4 (below) to 1 (above): darker to lighter than the room.
  Bgr ColorAt(int x, int y, Bgr empty, float shade) const;

 private:
  struct Light {
    float b = 0, g = 0, r = 0;
  };

  float grey_values_;
  Image<Light> smooth_;
};

}  // namespace mocap::simulation
