// Motions of the simulated person: a pose for every time.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/virtual_studio/people/skeleton.h"
#include "drivers/virtual_studio/room/furniture.h"

namespace mocap::simulation {

/// An endless motion. Reentrant.
class Motion {
 public:
  Motion() = default;
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;
  virtual ~Motion() = default;
  /// The pose at a time [s]; a smooth function of it.
  virtual BodyPose PoseAt(double t_s) const = 0;
  /// Furniture that the motion needs.
  virtual std::vector<Block> furniture() const { return {}; }
};

inline constexpr std::array<std::string_view, 12> kMotionNames = {
    "walk", "run",  "jump",  "dance",   "sit",   "rest",
    "lie",  "step", "stand", "gesture", "visit", "roll"};

/// Makes a motion for a person. The seed determines details such as path, tempo and starting side.
///
/// walk and run: a closed path · jump: on the spot · dance: twisting waist, arms up · sit: on a
/// stool and up again · rest: sit, still for a minute · lie: on the back, still for a minute ·
/// step: up a block and down · stand: idle · gesture: arms overhead, hands before the face, hands
/// folded · roll: a closed path in a wheelchair · visit: comes in through the door, walks around
/// and leaves, 3 s out of sight each time.
/// @throws SetupError  for another name.
std::unique_ptr<const Motion> MakeMotion(std::string_view name, const Anthropometry& body,
                                         std::uint64_t seed);

}  // namespace mocap::simulation
