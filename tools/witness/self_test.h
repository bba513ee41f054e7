// Whether a pose network computes what it should.
#pragma once

#include <filesystem>
#include <vector>

#include "core/evidence/keypoint_view.h"
#include "core/image.h"
#include "tools/witness/picture_region.h"
#include "tools/witness/pose_network.h"

namespace mocap {

/// A picture of a person whose joints are known.
struct KnownPicture {
  Image<Bgr> picture;
  PictureRegion box;             ///< Around the person.
  std::vector<Keypoint> joints;  ///< Shoulders, elbows, wrists, hips, knees and ankles.
};

/// Paints a person of the simulated studio who stands; always the same picture. What networks call
/// a joint is up to 3 % of the stature from the simulated one.
KnownPicture PaintKnownPicture();

/// Asks about that picture. OpenCV computes some networks wrong without a word, and a description
/// may be wrong.
/// @param model  for messages.
/// @throws SetupError  if the answer has numbers that are not finite, does not go with the picture
/// when the region moves, or if the joints that the network finds are not the person's.
void RequireGoodAnswers(PoseNetwork& network, const std::filesystem::path& model);

}  // namespace mocap
