#include "daemon/pipeline/tap.h"

#include <algorithm>

#include "drivers/clock.h"

namespace mocap {

bool CopyPixels(ImageView<const Bgr> from, Image<Bgr>& to) {
  if (from.width() != to.width() || from.height() != to.height()) return false;
  for (int y = 0; y < from.height(); ++y) std::copy_n(from.row(y), from.width(), to.row(y));
  return true;
}

bool CopyFrame(const Frame& from, TappedFrame& to) {
  if (!CopyPixels(from.image, to.image)) return false;
  to.capture_ns = from.capture_ns;
  to.offered_ns = SteadyNs();
  to.sequence = from.sequence;
  to.angles = from.angles;
  return true;
}

}  // namespace mocap
