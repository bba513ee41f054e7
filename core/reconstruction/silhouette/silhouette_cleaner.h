// §4: what noise leaves in a silhouette is taken out, what it takes from the person is put back.
#pragma once

#include <vector>

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Drops small blobs and fills holes; nothing is eroded, so that thin limbs stay.
///
/// Thread-bound; reuses its memory.
class SilhouetteCleaner {
 public:
  /// Empties blobs of fewer than `smallest` pixels. Blobs hang together over corners too.
  void DropBlobs(int smallest, Silhouette& silhouette);

  /// Empties blobs of fewer than `smallest` pixels, and those of fewer than `largest_thing` that
  /// are much smaller than the largest and lie apart from it: there is one person, and things that
  /// were moved are not part of it.
  void KeepPerson(int smallest, int largest_thing, Silhouette& silhouette);

  /// Fills holes of fewer than `smallest` pixels. What touches the picture's edge is no hole.
  void FillHoles(int smallest, Silhouette& silhouette);

  /// Fills holes of any size that are doubtful for two thirds: a leg in front of a wall of its
  /// own colour leaves such holes, the gap between an arm and the trunk does not.
  void FillHoles(int smallest, const Silhouette& doubtful, Silhouette& silhouette);

 private:
  enum class Kind { kBlobs, kHoles };
  // Pixels [begin, end) of one row, all of one kind; areas are kept at the root.
  struct Run {
    int y = 0;
    int begin = 0;
    int end = 0;
    int parent = 0;
    int area = 0;
    int doubtful = 0;
    bool at_edge = false;
  };
  void Connect(Kind kind, const Silhouette* doubtful, const Silhouette& silhouette);
  void CollectRuns(Kind kind, const Silhouette* doubtful, const Silhouette& silhouette);
  void MeasureBoxes();
  int RootOf(int run);
  void Join(int a, int b);

  std::vector<Run> runs_;
  std::vector<int> row_begins_;
  std::vector<PixelBox> boxes_;  // At the root.
};

}  // namespace mocap
