// Beyond the paper: clothes told from shadows by what all cameras see of the floor.
#pragma once

#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/silhouette.h"
#include "core/reconstruction/silhouette/silhouette_cleaner.h"

namespace mocap {

/// One camera's part in a set. Borrowed for the call.
struct ShadedView {
  int camera = 0;  ///< Its place among those that FloorShadows was made for.
  const SensorPlaneTable* table = nullptr;
  RigidTransform X_CW;
  const Shading* shading = nullptr;
  Silhouette* silhouette = nullptr;
  bool is_completed = false;  ///< The silhouette was.
};

/// Completes silhouettes by clothes that are darker than the floor behind them and nothing else.
///
/// One picture cannot tell such clothes from a shadow. But a shadow on the floor is a property of
/// the floor: all cameras that see the place see it dark. A dark pixel whose place on the floor is
/// as bright as ever in two other cameras, and dark in fewer, shows something that stands before
/// the floor. What the others tell nothing of goes with what surrounds it; thin rims are left
/// alone. Of very many cameras 31 others are asked. Thread-bound; reuses its memory.
class FloorShadows {
 public:
  explicit FloorShadows(std::span<const CameraCalibration> cameras);

  /// @pre  the pictures' tiles are those of their cameras.
  void Complete(std::span<ShadedView> views);

 private:
  void FindPeople(std::span<const ShadedView> views);
  enum class Verdict { kClothes, kShadow, kUnknown };
  void Vote(std::span<const ShadedView> views, std::size_t view);
  Verdict Judge(std::span<const ShadedView> views, std::size_t view, const Vector3& place_W,
                Shading::Shade shade) const;
  void Gather(std::span<const ShadedView> views, std::size_t view);
  void Open();

  // Of each camera, the direction of each tile's middle, at depth 1; zero where there is none.
  std::vector<std::vector<Vector3>> directions_C_;
  std::vector<Silhouette> people_;  // Of each view, the tiles at or beside its silhouette.
  Silhouette clothes_, shadows_;    // Tiles of the view that is being completed.
  std::vector<Shading::DarkTile> undecided_, joining_;
  Silhouette scratch_, added_, opened_;
  SilhouetteCleaner cleaner_;
};

}  // namespace mocap
