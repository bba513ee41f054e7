#include "core/reconstruction/carving/carving_view.h"

#include <algorithm>

namespace mocap {

std::optional<PixelBox> CarvingView::Box() const {
  const std::optional<PixelBox> person = silhouette->BoundingBox();
  if (!person || !unknown) return person;
  const PixelBox other = unknown->BoundingBox().value_or(*person);
  return PixelBox{std::min(person->left, other.left), std::min(person->top, other.top),
                  std::max(person->right, other.right), std::max(person->bottom, other.bottom)};
}

}  // namespace mocap
