#include "core/reconstruction/carving/unknown_share.h"

#include <cstdint>

namespace mocap {

std::optional<double> UnknownShare(const VoxelGrid& hull, const CarvingView& view) {
  const bool has_unknown = view.unknown && view.unknown->width() > 0;
  std::int64_t person = 0, unknown = 0;
  for (int k = 0; k < hull.size().z(); ++k) {
    for (int j = 0; j < hull.size().y(); ++j) {
      for (int i = 0; i < hull.size().x(); ++i) {
        if (!hull.Test(i, j, k)) continue;
        const Vector3 p_C = view.X_CW * hull.CenterOf(i, j, k);
        if (p_C.z() <= 0) continue;
        const auto pixel = view.table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z());
        if (pixel.x < 0) continue;
        person += view.silhouette->Test(pixel.x, pixel.y);
        unknown += has_unknown && view.unknown->Test(pixel.x, pixel.y);
      }
    }
  }
  if (person + unknown == 0) return {};
  return static_cast<double>(unknown) / static_cast<double>(person + unknown);
}

}  // namespace mocap
