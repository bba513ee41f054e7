// Beyond the paper: the pixels of a camera at which the empty studio was never seen.
#pragma once

#include <span>

#include "core/reconstruction/background/conditions.h"
#include "core/reconstruction/silhouette/background_model.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Knows where a camera can tell nothing: there, no difference from the background shows a person,
/// and no likeness shows that nobody is there. Thread-bound; reuses its memory.
class UnseenPlaces {
 public:
  /// @param background  a pixel that one of its pictures does not know is unseen.
  /// @pre  the pictures have one size.
  explicit UnseenPlaces(std::span<const BackgroundFrame> background);

  bool empty() const { return !unseen_.BoundingBox(); }
  /// Follows a camera that was nudged. @return  valid until the next call.
  const Silhouette& At(const Displacement& displacement);
  /// Leaves unseen places out of a picture's shading.
  /// @param unseen  from At().
  static void LeaveOut(const Silhouette& unseen, Shading& shading);

 private:
  Silhouette unseen_, displaced_;
};

}  // namespace mocap
