// §4: cleanup: removes noise from a silhouette and fills what noise took from the person.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Drops small blobs and fills holes. Nothing is eroded, so that thin limbs stay.
///
/// Blobs also connect at corners, holes do not. A region that touches the picture's edge is no
/// hole. Holes are filled first: blobs beside a filled hole and within it become one blob.
/// Thread-bound; reuses its memory.
class SilhouetteCleaner {
 public:
  /// Clears blobs of fewer than `smallest` pixels.
  void DropBlobs(int smallest, Silhouette& silhouette);

  /// Fills holes of fewer than `smallest_hole` pixels, and holes of any size if two thirds of them
  /// are doubtful. A leg in front of a wall of its own colour leaves such holes; the gap between an
  /// arm and the trunk does not. Clears blobs of fewer than `smallest_blob` pixels.
  void Clean(int smallest_hole, const Silhouette& doubtful, int smallest_blob,
             Silhouette& silhouette);

  /// Fills holes of fewer than `smallest_hole` pixels. Clears blobs of fewer than `smallest_blob`
  /// pixels. Also clears blobs of fewer than `largest_thing` pixels that are much smaller than the
  /// largest and apart from it: there is one person, and moved things do not belong to it.
  void KeepPerson(int smallest_hole, int smallest_blob, int largest_thing, Silhouette& silhouette);

 private:
  // Pixels of one kind in a row, from the end of the previous run. The runs of a row alternate:
  // outside on the left, a blob, a hole, … a blob, outside on the right.
  struct Run {
    int end;
    int part;
  };
  // A blob, a hole, or the outside. Parts are numbered in the order of their first pixels.
  // Connected parts have the number of the first of them.
  struct Part {
    int whole;   // The first part it is connected with.
    int around;  // The part before its first pixel, which surrounds it.
    int area;
    bool is_blob;
    bool is_set = false;
    int doubtful = 0;
  };

  void Connect(const Silhouette& silhouette);
  int CollectRuns(std::span<const std::uint64_t> row, int right, int first);
  static bool GoesOn(const Run* above, const Run* here, int count);
  void Follow(const Run* above, Run* here, int count);
  void ConnectRow(const Run* above, Run* here, int count);
  void Add(int begin, int part, Run& run);
  int WholeOf(int part);
  int Join(int a, int b);
  template <typename Visit>
  void ForEachRun(Visit visit);
  void CountDoubtful(int smallest, const Silhouette& doubtful);
  template <typename IsFilled>
  void FillHoles(IsFilled is_filled);
  void KeepBlobs(int smallest);
  void DropThings(int largest_thing);
  void MeasureBoxes();
  void Write(Silhouette& silhouette);

  std::vector<Run> runs_;
  std::vector<int> row_begins_;  // And the end of the last.
  std::vector<Part> parts_;
  std::vector<PixelBox> boxes_;  // Of blobs.
};

}  // namespace mocap
