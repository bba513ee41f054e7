// §4: from silhouettes to voxels.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

struct CarvingOptions {
  double voxel_mm = 25;
  /// Somebody may be beside a picture that shows somebody else, so that the whole room is carved. A
  /// person who is alone is within the box that the silhouettes span.
  bool several_people = false;
};

/// Carves the person out of the volume of interest that the silhouettes span.
///
/// A voxel is sampled at 2 × 2 × 2 places and kept when the majority of them agrees with all
/// silhouettes; of five cameras or more, one in five may have it in a narrow gap of its silhouette
/// instead. A camera that cannot see a place does not carve it, but at least two cameras, and
/// half of those in the set, must see it. A camera whose silhouette is empty is taken for one that
/// cannot see the person. Mikić et al. 2003, §4. Beyond the paper, of five cameras and more one in
/// five may lack a place that lies in a gap of its silhouette (a closing by 6 px fills it), because
/// clothes of the background's colour leave such gaps. Thread-bound; reuses its memory.
class Carver {
 public:
  static constexpr int kMostViews = 64;

  explicit Carver(const CarvingOptions& options);
  Carver(Carver&&) noexcept;
  Carver& operator=(Carver&&) noexcept;
  ~Carver();

  /// Carves one set. With nothing to see the grid has no voxels.
  /// @pre  there are at most kMostViews.
  /// @post the result does not depend on how the work is divided.
  void Carve(std::span<const CarvingView> views, VoxelGrid& grid);
  /// Where a person who is alone is, in the last set [mm, world]; empty without anybody.
  const Eigen::AlignedBox3d& person_box_W() const;

 private:
  class Walk;

  std::unique_ptr<Walk> walk_;
};

}  // namespace mocap
