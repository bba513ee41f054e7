// How a picture is to be turned before it is shown: telephones record as they are held, and say so.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "core/image.h"

namespace mocap {

/// A turn by quarters, with or without a mirror: a place (x, y) of the recorded picture goes to
/// (a x + c y, b x + d y), moved so that all of them are in the shown one.
struct PictureTurn {
  int a = 1, b = 0, c = 0, d = 1;

  friend bool operator==(const PictureTurn&, const PictureTurn&) = default;

  bool IsNone() const { return *this == PictureTurn{}; }
  bool SwapsSides() const { return a == 0; }
  /// Says it to a person: "turned right by 90 degrees".
  std::string Text() const;
};

/// Reads FFmpeg's display matrix (16.16 fixed point, as in the files of telephones). Empty where it
/// is no turn by quarters.
std::optional<PictureTurn> TurnFromDisplayMatrix(const std::array<std::int32_t, 9>& matrix);

/// Turns a picture. @param out  of the shown size.
void Turn(const PictureTurn& turn, ImageView<const Bgr> in, ImageView<Bgr> out);

}  // namespace mocap
