// Beyond the paper: distinguishes clothes from shadows by all cameras' views of the floor.
#pragma once

#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/silhouette.h"
#include "core/reconstruction/silhouette/silhouette_cleaner.h"
#include "core/reconstruction/silhouette/trimap.h"

namespace mocap {

/// One camera's part in a set. Borrowed for the call.
struct ShadedView {
  int camera = 0;  ///< Its index among the cameras that FloorShadows was made for.
  const SensorPlaneTable* table = nullptr;
  RigidTransform X_CW;
  const Shading* shading = nullptr;
  Trimap* trimap = nullptr;
  bool has_changed = false;  ///< Whether the trimap was.
};

/// Decides about unknown pixels of the floor: clothes whose only difference from the floor behind
/// is being darker, or shadows.
///
/// One picture cannot distinguish such clothes from a shadow. But a shadow lies on the floor: every
/// camera that sees the place sees it dark. If a dark pixel's place on the floor has its usual
/// brightness in at least two other cameras, and is dark in fewer, something stands in front of the
/// floor. If the other cameras do not decide, a tile follows its neighbours. Thin rims are left
/// out. Where others see it dark, too, the place is empty, as are the tiles around it. With very
/// many cameras, 31 others are asked. Thread-bound; reuses its memory.
class FloorShadows {
 public:
  explicit FloorShadows(std::span<const CameraCalibration> cameras);

  /// @pre  the pictures' tiles are those of their cameras.
  void Complete(std::span<ShadedView> views);

 private:
  void FindPeople(std::span<const ShadedView> views);
  enum class Cause { kClothes, kShadow, kUnknown };
  void Vote(std::span<const ShadedView> views, std::size_t view);
  Cause Judge(std::span<const ShadedView> views, std::size_t view, const Vector3& place_W,
              Shading::Shade shade) const;
  void Gather(std::span<const ShadedView> views, std::size_t view);
  void Open();
  // Return whether anything changed.
  bool AddClothes(const Silhouette& dark, Trimap& trimap);
  bool DropShadows(const Shading& shading, Silhouette& unknown);

  // For each camera, the direction of each tile's centre, at depth 1; zero if there is none.
  std::vector<std::vector<Vector3>> directions_C_;
  std::vector<Silhouette> people_;  // For each view, the tiles at or beside its silhouette.
  Silhouette clothes_, shadows_;    // Tiles of the view that is being completed.
  std::vector<Shading::DarkTile> undecided_, joining_;
  Silhouette scratch_, added_, opened_;
  SilhouetteCleaner cleaner_;
};

}  // namespace mocap
