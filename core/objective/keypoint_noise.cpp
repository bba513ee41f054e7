#include "core/objective/keypoint_noise.h"

#include <algorithm>

namespace mocap {

double KeypointScale_mm(Landmark, double score) {
  return 24 / std::sqrt(std::clamp(score, 0.05, 1.0));
}

}  // namespace mocap
