#include "tools/import/light_check.h"

#include <algorithm>

namespace mocap {

void LightMeter::Add(ImageView<const Bgr> picture) {
  Image<Bgr> smooth = Smooth(picture);
  if (first_.empty()) {
    first_ = std::move(smooth);
    return;
  }
  const LightGain gain = LightBetween(first_, smooth);
  const double brightness = (gain[0] + gain[1] + gain[2]) / 3, red = gain[2] / gain[0];
  range_.darkest = std::min(range_.darkest, brightness);
  range_.brightest = std::max(range_.brightest, brightness);
  range_.bluest = std::min(range_.bluest, red);
  range_.reddest = std::max(range_.reddest, red);
}

}  // namespace mocap
