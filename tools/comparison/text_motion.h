// Motion in text files: TRC, OpenSim's motion and storage files, BVH, and CSV.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tools/comparison/recorded_motion.h"

namespace mocap {

/// Reads OpenSim's marker files. Markers named "subject:LHEE" are those of a subject.
/// @throws SetupError  here and below: names file and line.
MotionFile ReadTrc(const std::filesystem::path& file);

/// Reads joint angles of OpenSim (.mot, .sto), also names such as
/// /jointset/knee_r/knee_angle_r/value. pelvis_tx, pelvis_ty and pelvis_tz become the point
/// kPelvisOrigin. Files of before inDegrees was written are in degrees.
MotionFile ReadMot(const std::filesystem::path& file);

/// Reads places and rotations of a skeleton's joints. Ends of limbs are named after their joint:
/// LeftHandEnd. The format states no unit.
MotionFile ReadBvh(const std::filesystem::path& file);

/// Reads tables with columns such as knee_l_x_mm and knee_angle_l_deg, and the time in time_s,
/// timestamp_ns or utime_us: truth.csv of takes, and `mocap export --format csv`.
MotionFile ReadCsvMotion(const std::filesystem::path& file);

/// Where OpenSim's models have the pelvis' frame.
inline constexpr std::string_view kPelvisOrigin = "pelvis origin";

/// Divides points into subjects by the prefixes of their names. @param file  for messages.
/// @throws SetupError  for more than a hundred.
std::vector<RecordedMotion> BySubject(RecordedMotion all, const std::string& file);

}  // namespace mocap
