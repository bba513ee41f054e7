// §4: from silhouettes to voxels.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

struct CarvingOptions {
  double voxel_mm = 25;
  /// Whether several people may be present. Then somebody may be outside one picture while it shows
  /// somebody else, so the whole room is carved. A single person is within the box that the
  /// silhouettes span.
  bool several_people = false;
  /// Whether unknown pixels carve, as in the paper, which decides every pixel.
  bool hard_silhouettes = false;
};

/// Carves the person out of the volume of interest that the silhouettes span.
///
/// A voxel has 2 × 2 × 2 samples and is kept if most of them agree with all silhouettes. A camera
/// that cannot see a sample does not carve it. At least two cameras, and half of those in the set,
/// must see it. A camera with an empty silhouette counts as one that cannot see the person. Mikić
/// et al. 2003, §4. Beyond the paper, an unknown pixel does not carve either, as long as no fewer
/// cameras show the person there than do not know, and cameras that call it empty may be
/// outweighed by as many more that show the person. Thread-bound; reuses its memory.
class Carver {
 public:
  static constexpr int kMostViews = 64;

  explicit Carver(const CarvingOptions& options);
  Carver(Carver&&) noexcept;
  Carver& operator=(Carver&&) noexcept;
  ~Carver();

  /// Carves one set. If nothing is seen, the grid has no voxels.
  /// @param doubtful  overwritten with the cells that only unknown pixels keep out; may be null.
  /// @pre  there are at most kMostViews.
  /// @post the result does not depend on how the work is divided.
  void Carve(std::span<const CarvingView> views, VoxelGrid& grid,
             std::vector<Eigen::Vector3i>* doubtful = nullptr);
  /// Box around a single person in the last set [mm, world]; empty if nobody is there.
  const Eigen::AlignedBox3d& person_box_W() const;

 private:
  class Walk;

  std::unique_ptr<Walk> walk_;
};

}  // namespace mocap
