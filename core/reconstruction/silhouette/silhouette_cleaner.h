// §4: cleanup: removes noise from a silhouette and fills what noise took from the person.
#pragma once

#include <cstddef>
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

  /// Fills all holes.
  void FillHoles(Silhouette& silhouette);

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
  // Adjacent pixels of one kind in a row.
  struct Run {
    int y, begin, end;
    int part;
  };
  static constexpr int kFar = 1 << 30;
  // A blob, a hole, or the outside, which is the first part. Parts are numbered in the order of
  // their first pixels. Connected parts have the number of the first of them.
  struct Part {
    int whole;   // A part with a lower number that it is connected with, or itself.
    int around;  // The part to the left of its first pixel, which surrounds it.
    bool is_blob;
    bool is_set = false;
    int area = 0;
    int doubtful = 0;  // Pixels of the area.
    PixelBox box{kFar, kFar, -1, -1};
  };

  void FindParts(const Silhouette& silhouette, const Silhouette* doubtful);
  int PartOf(const Run& run, bool is_blob, bool is_outside, std::size_t above, std::size_t row);
  int WholeOf(int part);
  int Join(int a, int b);
  template <typename IsFilled>
  void FillHolesIf(IsFilled is_filled);
  void KeepBlobs(int smallest);
  void DropThings(int largest_thing);
  void Write(Silhouette& silhouette);

  std::vector<Run> runs_;  // Row by row, from left to right.
  std::vector<Part> parts_;
};

}  // namespace mocap
