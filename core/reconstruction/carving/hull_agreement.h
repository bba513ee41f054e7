// §4: agreement of each camera's silhouette with the hull that the other cameras carve.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/silhouette/silhouette_shift.h"

namespace mocap {

/// Compares each camera of a set with the others (with at most 31 of them). A camera that was
/// bumped sees the person beside the place where they see him. Thread-bound; reuses its memory.
class HullAgreement {
 public:
  HullAgreement();

  /// Compares a set's silhouettes with the hulls of the other cameras.
  /// @return  one for each view, valid until the next call. Empty if no complete silhouettes can be
  /// compared: nobody is there, somebody is partly outside the picture, or fewer than three cameras
  /// see him.
  const std::vector<std::optional<SilhouetteShift>>& Measure(std::span<const CarvingView> views);

  /// Returns the person's position from all cameras [mm, world]; empty if nobody is there.
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
