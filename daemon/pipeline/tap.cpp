#include "daemon/pipeline/tap.h"

#include <algorithm>

#include "drivers/clock.h"

namespace mocap {

bool CopyFrame(const Frame& from, TappedFrame& to) {
  const bool fits =
      from.image.width() == to.image.width() && from.image.height() == to.image.height();
  if (!fits) return false;
  for (int y = 0; y < from.image.height(); ++y) {
    std::copy_n(from.image.row(y), from.image.width(), to.image.row(y));
  }
  to.capture_ns = from.capture_ns;
  to.offered_ns = SteadyNs();
  to.sequence = from.sequence;
  to.angles = from.angles;
  return true;
}

}  // namespace mocap
