// Comparing pixels.
#pragma once

#include <algorithm>

#include "core/image.h"

namespace mocap::testing {

template <typename T>
bool SamePixels(ImageView<const T> a, ImageView<const T> b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  for (int y = 0; y < a.height(); ++y) {
    if (!std::equal(a.row(y), a.row(y) + a.width(), b.row(y))) return false;
  }
  return true;
}

template <typename T>
Image<std::remove_const_t<T>> CopyOf(ImageView<T> view) {
  Image<std::remove_const_t<T>> image(view.width(), view.height());
  for (int y = 0; y < view.height(); ++y) std::copy_n(view.row(y), view.width(), image.row(y));
  return image;
}

}  // namespace mocap::testing
