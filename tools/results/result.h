// The result of tracking: RESULT/poses.csv and RESULT/body.toml, or the log of its messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_part.h"
#include "core/body/pose_state.h"
#include "core/motion_capture.h"

namespace mocap {

/// One frame set: a row of poses.csv.
struct PoseRow {
  std::int64_t frame = 0;
  std::int64_t timestamp_ns = 0;  ///< Of capture.
  CaptureState state = CaptureState::kSearching;
  bool has_pose = false;  ///< Without one, the pose, the points and the residual mean nothing.
  PaperState paper;
  BodyPoints points_W = BodyPoints::Zero();  ///< p_WQ of the 23 points, after the filter [mm].
  double residual_mm = 0;
  int voxels = 0;
  /// Bit k: camera k was used, of the first seven; 0: not known. Of logs alone.
  std::uint8_t first_cameras = 0;
};

/// The acquired body: body.toml.
struct BodyRecord {
  std::string model;  ///< Name of the body table.
  double stature_mm = 0;
  BodySizes sizes;
};

struct Result {
  BodyRecord body;
  std::vector<PoseRow> poses;  ///< In the order of the frames.
  /// What was read but is not here, as damage of a log, a line each.
  std::vector<std::string> remarks = {};
};

/// Makes the row of what a set came to.
PoseRow PoseRowOf(std::int64_t frame, std::int64_t capture_ns, const CaptureResult& result,
                  const BodyModel& body);
/// Makes the record of a body.
BodyRecord RecordOf(const BodyModel& body);

/// Makes sure, before the work, that WriteResult and WritePeople can keep a result in a folder:
/// makes it, and tells of files of the same names that are somebody's.
/// @throws SetupError  naming folder or file.
void RequireRoomForResult(const std::filesystem::path& folder);

/// Writes RESULT/poses.csv and RESULT/body.toml; the folder is made, files that are there are
/// replaced, each in one step, and what an earlier run left of several people goes. The same result
/// gives the same bytes.
/// @throws std::runtime_error  when the folder cannot be written.
void WriteResult(const std::filesystem::path& folder, const Result& result);

/// RESULT/person-1 and so on, in the order of their numbers. @pre the folder is there.
std::vector<std::filesystem::path> PersonFolders(const std::filesystem::path& folder);
/// The same for several people: RESULT/person-K is the result of person K. What an earlier run left
/// of others, or of one person, goes.
void WritePeople(const std::filesystem::path& folder, const std::map<int, Result>& people);

/// Whether a folder is what WritePeople left.
bool IsOfPeople(const std::filesystem::path& folder);
/// Results of people who were tracked together, with names: person-1, or their own.
using PeopleResults = std::vector<std::pair<std::string, Result>>;
/// Reads such a folder, or a log of MOCAP_PEOPLE and MOCAP_BODIES messages.
/// @param prefix  of a log, as of ReadResult.
/// @throws SetupError  as ReadResult.
PeopleResults ReadPeople(const std::filesystem::path& folder_or_log,
                         const std::optional<std::string>& prefix = {});

/// Reads a folder that WriteResult left, or a log of MOCAP_POSE and MOCAP_BODY messages as
/// lcm-logger records them.
/// @param prefix  of a log: what stands before the channels' names; empty: any, of one daemon.
/// @throws SetupError  when it is neither, or is damaged; names file and line.
Result ReadResult(const std::filesystem::path& folder_or_log,
                  const std::optional<std::string>& prefix = {});

}  // namespace mocap
