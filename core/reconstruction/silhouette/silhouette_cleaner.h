// §4: what noise leaves in a silhouette is taken out, what it takes from the person is put back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Drops small blobs and fills holes; nothing is eroded, so that thin limbs stay.
///
/// Blobs hang together over corners too, holes do not. What touches the picture's edge is no hole.
/// Holes are filled first: blobs beside one that is filled, and within it, become one blob.
/// Thread-bound; reuses its memory.
class SilhouetteCleaner {
 public:
  /// Empties blobs of fewer than `smallest` pixels.
  void DropBlobs(int smallest, Silhouette& silhouette);

  /// Fills holes of fewer than `smallest_hole` pixels, and those of any size that are doubtful for
  /// two thirds: a leg in front of a wall of its own colour leaves such holes, the gap between an
  /// arm and the trunk does not. Empties blobs of fewer than `smallest_blob` pixels.
  void Clean(int smallest_hole, const Silhouette& doubtful, int smallest_blob,
             Silhouette& silhouette);

  /// Fills holes of fewer than `smallest_hole` pixels. Empties blobs of fewer than `smallest_blob`
  /// pixels, and those of fewer than `largest_thing` that are much smaller than the largest and lie
  /// apart from it: there is one person, and things that were moved are not part of it.
  void KeepPerson(int smallest_hole, int smallest_blob, int largest_thing, Silhouette& silhouette);

 private:
  // The pixels of one row from where the run before ends, all of one kind. A row's runs take turns:
  // what lies outside to the left, a blob, a hole, … a blob, what lies outside to the right.
  struct Run {
    int end;
    int part;
  };
  // A blob, a hole, or what lies outside. They are numbered in the order of their first pixels,
  // and what hangs together has the number of its first part.
  struct Part {
    int whole;   // What it hangs together with.
    int around;  // What lies before its first pixel, and all around it.
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
  std::vector<int> row_begins_;  // And where the last ends.
  std::vector<Part> parts_;
  std::vector<PixelBox> boxes_;  // Of blobs.
};

}  // namespace mocap
