#include "core/reconstruction/background/change_meter.h"

#include <cstdlib>

namespace mocap {
namespace {

constexpr int kClearDifference = 40;
constexpr int kMeterStep_px = 4;

bool Differs(const Bgr& a, const Bgr& b) {
  return std::abs(a.b - b.b) > kClearDifference || std::abs(a.g - b.g) > kClearDifference ||
         std::abs(a.r - b.r) > kClearDifference;
}

}  // namespace

double ChangeMeter::Measure(ImageView<const Bgr> image) {
  const int columns = (image.width() + kMeterStep_px - 1) / kMeterStep_px;
  const int rows = (image.height() + kMeterStep_px - 1) / kMeterStep_px;
  const bool is_first = first_.empty();
  if (is_first) first_ = Image<Bgr>(columns, rows);
  int changed = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Bgr pixel = image(x * kMeterStep_px, y * kMeterStep_px);
      if (is_first) first_(x, y) = pixel;
      changed += Differs(pixel, first_(x, y));
    }
  }
  return static_cast<double>(changed) / (columns * rows);
}

}  // namespace mocap
