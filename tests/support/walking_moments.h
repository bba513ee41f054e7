// The walk of walking_silhouettes.h as diagnoses see it.
#pragma once

#include <vector>

#include "core/calibration/seen_shape.h"
#include "tests/support/walking_silhouettes.h"

namespace mocap::testing {

inline std::vector<SeenMoment> WalkingMoments() {
  const WalkingSilhouettes& walk = WalkOfTenSeconds();
  std::vector<SeenMoment> moments;
  for (const std::vector<Silhouette>& silhouettes : walk.moments) {
    SeenMoment& moment = moments.emplace_back();
    for (std::size_t c = 0; c < silhouettes.size(); ++c)
      moment.push_back(ShapeOf(silhouettes[c], walk.cameras[c].X_CW));
  }
  return moments;
}

/// Exchanges what two cameras show, but not where they stand.
inline void ExchangePictures(std::size_t a, std::size_t b, std::vector<SeenMoment>& moments) {
  for (SeenMoment& moment : moments) {
    std::swap(moment[a], moment[b]);
    std::swap(moment[a]->X_CW, moment[b]->X_CW);
  }
}

}  // namespace mocap::testing
