// How much of a simulated person the room and its cameras hold.
#pragma once

namespace mocap {

/// How much of a person is visible.
struct PersonPresence {
  bool in_room = false;  ///< Any part of the body is on the room's side of the door.
  bool whole = false;    ///< The whole body is.
  int pictures = 0;      ///< Number that have the whole body within their borders, hidden or not.
};

/// A person is covered if this many pictures have the whole body.
inline constexpr int kCoveringPictures = 4;

}  // namespace mocap
