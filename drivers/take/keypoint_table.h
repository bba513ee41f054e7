// keypoints.csv: what a pose network says of the people in a take.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <vector>

#include "core/evidence/keypoint_view.h"

namespace mocap {

/// Writes the table `camera,timestamp_ns,person,name,x_px,y_px,score`: a row for each keypoint, in
/// the order given. Pixels and scores have three decimals. Views without points leave no row.
void WriteKeypoints(std::ostream& out, std::span<const KeypointView> views);

/// Reads such a table. Rows of one camera, time and person are one view, whose points keep their
/// order. Names may be those of COCO, HALPE and BlazePose.
///
/// @return  sorted by time; views of one time keep their order.
/// @throws SetupError  naming file and line: no such header, a name that is no landmark or comes
/// twice in a view, text instead of a number, a score outside 0 to 1.
std::vector<KeypointView> ReadKeypoints(const std::filesystem::path& file);

}  // namespace mocap
