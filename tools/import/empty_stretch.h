// Stretches of a video in which nobody is there.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/image.h"

namespace mocap {

/// Finds when a room was empty, from small copies of pictures: what is the same then as it mostly
/// is. Thread-bound.
class EmptyStretch {
 public:
  /// @pre  all pictures have one size.
  void Add(double time_s, ImageView<const Bgr> picture);

  struct Stretch {
    double from_s, to_s;
  };
  /// The longest stretch of pictures without people, of 2 s at least; empty if there is none, or
  /// people never are there: then somebody may have stayed in one place.
  std::optional<Stretch> Longest() const;

 private:
  std::vector<double> OccupiedShares() const;

  int columns_ = 0, rows_ = 0;
  std::vector<double> times_s_;
  std::vector<std::vector<Bgr>> small_;
};

}  // namespace mocap
