// Where bodies of tests stand.
#pragma once

#include "core/body/body_sizes.h"

namespace mocap {

/// Height of the torso's centroid of somebody who stands upright in shoes, whose soles are 20 mm
/// thick [mm].
inline double StandingHeight(const BodySizes& sizes) {
  constexpr double kShoes_mm = 20;
  return sizes.torso / 2 + sizes.thigh + sizes.calf + kShoes_mm;
}

}  // namespace mocap
