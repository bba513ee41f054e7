// Rotation of a picture for display: telephones record as they are held, and store the rotation.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/image.h"

namespace mocap {

/// A rotation by quarter turns, optionally mirrored. Point (x, y) of the recorded picture goes to
/// (a x + c y, b x + d y), shifted so that all points lie in the displayed picture.
struct PictureTurn {
  int a = 1, b = 0, c = 0, d = 1;

  friend bool operator==(const PictureTurn&, const PictureTurn&) = default;

  bool IsNone() const { return *this == PictureTurn{}; }
  bool SwapsSides() const { return a == 0; }
  /// Describes it for people: "turned right by 90 degrees".
  std::string Text() const;
};

/// Converts FFmpeg's display matrix (16.16 fixed point, as in telephones' files). Empty if it is
/// not a rotation by quarter turns.
std::optional<PictureTurn> TurnFromDisplayMatrix(const std::array<std::int32_t, 9>& matrix);

/// Matroska stores no display matrix. A tag of its video stream with this name says by how many
/// degrees to turn the picture to the right, as FFmpeg once wrote it into MP4 files.
inline constexpr const char* kTurnTag = "rotate";

/// The tag's value; empty for a mirrored picture, which it cannot describe.
std::optional<std::string> TurnInDegrees(const PictureTurn& turn);
/// Reads the tag's value. Empty if it is not a multiple of 90.
std::optional<PictureTurn> TurnFromDegrees(std::string_view text);

/// Rotates a picture. @param out  has the displayed size.
void Turn(const PictureTurn& turn, ImageView<const Bgr> in, ImageView<Bgr> out);

}  // namespace mocap
