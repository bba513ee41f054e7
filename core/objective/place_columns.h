// Points in columns, for the search of the nearest.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/evidence/contact.h"

namespace mocap {

/// Points in columns. After the last there may be some at infinite distance.
class PlaceColumns {
 public:
  /// Copies the positions of the contacts that are not edges.
  void Set(std::span<const Contact> contacts);
  int size() const { return size_; }
  /// The nearest to a point; the first of several. @pre there is one.
  Vector3 NearestTo(const Vector3& p_W) const;

 private:
  int size_ = 0;
  std::array<std::vector<double>, 3> axes_;
};

}  // namespace mocap
