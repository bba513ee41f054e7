// §4: whether each camera's silhouette agrees with the hull that the other cameras carve.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/silhouette/silhouette_shift.h"

namespace mocap {

/// Holds each camera of a set against the others, 31 of very many: one that was bumped sees the
/// person beside the place where they put him. Thread-bound; reuses its memory.
class HullAgreement {
 public:
  HullAgreement();

  /// Compares a set's silhouettes with the others' hulls.
  /// @return  one for each view, until the next call; empty where nothing whole can be compared:
  /// nobody is there, somebody stands half outside of the picture, or fewer than three cameras see.
  const std::vector<std::optional<SilhouetteShift>>& Measure(std::span<const CarvingView> views);

  /// Where the person is by all cameras together [mm, world]; empty when nobody is.
  std::optional<Vector3> PlaceOf(std::span<const CarvingView> views);

 private:
  std::optional<SilhouetteShift> MeasureOne(std::span<const CarvingView> views, std::size_t view);

  Carver carver_;
  VoxelGrid hull_;
  Silhouette expected_;
  std::vector<CarvingView> others_;
  std::vector<std::optional<SilhouetteShift>> shifts_;
};

}  // namespace mocap
