#include "daemon/status/moved_furniture.h"

#include <fmt/format.h>

#include <algorithm>

namespace mocap {

std::string PlaceInPicture(const PixelBox& box, int width_px, int height_px) {
  constexpr const char* kRows[] = {"top", "middle", "bottom"};
  constexpr const char* kColumns[] = {"left", "middle", "right"};
  const int row = std::min(3 * (box.top + box.bottom) / 2 / height_px, 2);
  const int column = std::min(3 * (box.left + box.right) / 2 / width_px, 2);
  const std::string words =
      row == 1 && column == 1 ? "middle" : fmt::format("{} {}", kRows[row], kColumns[column]);
  return fmt::format("{}, x {} to {}, y {} to {} px", words, box.left, box.right, box.top,
                     box.bottom);
}

std::string ShareText(double share) {
  return share < 0.1 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

}  // namespace mocap
