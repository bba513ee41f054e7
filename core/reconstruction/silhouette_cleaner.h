// §4: what noise leaves in a silhouette is taken out, what it takes from the person is put back.
#pragma once

#include <cstdint>
#include <vector>

#include "core/reconstruction/silhouette.h"

namespace mocap {

/// Drops small blobs and fills small holes; nothing is eroded, so that thin limbs stay.
///
/// Thread-bound; reuses its memory.
class SilhouetteCleaner {
 public:
  /// @param smallest_blob_share  blobs and holes smaller than this share of the picture go.
  explicit SilhouetteCleaner(double smallest_blob_share) : smallest_share_(smallest_blob_share) {}

  void Clean(Silhouette& silhouette);

 private:
  // Pixels [begin, end) of one row, all of one kind.
  struct Run {
    int y, begin, end;
    int parent;
    int area;
  };
  enum class Kind { kBlobs, kHoles };
  void RemoveSmall(Kind kind, int smallest, Silhouette& silhouette);
  void CollectRuns(Kind kind, const Silhouette& silhouette);
  int RootOf(int run);
  void Join(int a, int b);

  double smallest_share_;
  std::vector<Run> runs_;
  std::vector<int> row_begins_;
};

}  // namespace mocap
