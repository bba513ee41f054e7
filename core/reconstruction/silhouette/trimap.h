// Beyond the paper: what one camera says about each pixel.
#pragma once

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// The pixels of a picture in three kinds: person, unknown, and empty, which are the others.
///
/// Clothes of the wall's colour and places that may lie in a shadow are unknown.
struct Trimap {
  Silhouette person;
  Silhouette unknown;  ///< Holds no pixel of `person`; may be without size.
};

}  // namespace mocap
