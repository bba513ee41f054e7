// Which markers and joints of other systems lie at which points of the body.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/comparison/recorded_motion.h"

namespace mocap {

/// A point of a result, and the markers of another recording whose middle is there.
struct NamedPair {
  std::string point;
  std::vector<std::string> others;
};

/// Finds pairs by the names of conventions: ours, of poses.csv and the exports; Vicon's Plug-in
/// Gait; the marker sets of OpenSim's models (Rajagopal 2016, gait2354); BVH skeletons such as
/// LAFAN1's and Mixamo's; truth.csv of takes. Capitals, blanks and underscores do not matter.
/// Where medial and lateral markers are there, their middle is the joint. A point may have several
/// pairs, the likeliest first, and a marker may belong to several points: motion decides.
std::vector<NamedPair> PairsByName(const RecordedMotion& other);

/// The points that a name of any convention can mean; none if it is unknown.
std::vector<std::string> PointsNamed(std::string_view name);

}  // namespace mocap
