// Result of tracking: RESULT/poses.csv and RESULT/body.toml, or a log of messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
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
  std::int64_t timestamp_ns = 0;  ///< Capture time.
  CaptureState state = CaptureState::kSearching;
  bool has_pose = false;  ///< If false, the pose, the points and the residual are meaningless.
  PaperState paper;
  BodyPoints points_W = BodyPoints::Zero();  ///< p_WQ of the 23 points, after the filter [mm].
  /// Standard deviation of each, along its worst axis [mm]; NaN: not known.
  PointStds point_std_mm = PointStds::Constant(std::numeric_limits<double>::quiet_NaN());
  /// The points that follow the 23, and their deviations; NaN: not known.
  FurtherPoints further_W = FurtherPoints::Constant(std::numeric_limits<double>::quiet_NaN());
  FurtherStds further_std_mm = FurtherStds::Constant(std::numeric_limits<double>::quiet_NaN());
  /// How likely heels and toes touch the floor, 0 to 1; NaN: not known.
  Contacts contacts = kUnknownContacts;
  /// In the order of BodyRecord::joints; NaN: not known. Empty if it was measured for another body.
  JointAngles joint_rad = {};
  /// Of the pose, 0 to 1; NaN: not known.
  double probability = std::numeric_limits<double>::quiet_NaN();
  double residual_mm = 0;
  int voxels = 0;
  /// Bit k: camera k was used, of the first seven; 0: not known. Only from logs.
  std::uint8_t first_cameras = 0;
};

/// A joint of the body, as its body table and messages name it.
struct JointRecord {
  std::string name;
  int paper_angle = 0;  ///< 1..16 as in Table 1; 0: another, or not known.
};

/// The acquired body: body.toml.
struct BodyRecord {
  std::string model;  ///< Name of its body table.
  double stature_mm = 0;
  BodySizes sizes;
  std::vector<JointRecord> joints = {};  ///< In the order of the body table.
};

/// Table [take] of body.toml: what was tracked.
struct TakeMark {
  std::string name;         ///< As in take.toml.
  std::string calibration;  ///< Checksum.
};

struct Result {
  BodyRecord body;
  std::vector<PoseRow> poses;  ///< In order of frames.
  /// What could not be read, such as damage of a log, one line each.
  std::vector<std::string> remarks = {};
  std::optional<TakeMark> take = {};  ///< Not known of logs.
  /// Of a solved take: its filter, such as butterworth:4:6, or none. Empty: tracked as live.
  std::optional<std::string> filter = {};
};

/// Makes the row of a frame set.
PoseRow PoseRowOf(std::int64_t frame, std::int64_t capture_ns, const CaptureResult& result,
                  const BodyModel& body);
/// Makes the record of a body.
BodyRecord RecordOf(const BodyModel& body);

/// Whether a folder has the result of somebody who was tracked.
bool HasPoses(const std::filesystem::path& folder);

/// Checks in advance that WriteResult and WritePeople can write to a folder: creates it, and
/// reports files of the same names that are not results, and takes.
/// @throws SetupError  naming folder or file.
void RequireRoomForResult(const std::filesystem::path& folder);

/// Writes RESULT/poses.csv and RESULT/body.toml. Creates the folder, replaces existing files
/// atomically, and removes an earlier run's results of several people. The same result gives the
/// same bytes.
/// @throws std::runtime_error  when the folder cannot be written.
void WriteResult(const std::filesystem::path& folder, const Result& result);

/// RESULT/person-1 and so on, in numeric order. @pre the folder exists.
std::vector<std::filesystem::path> PersonFolders(const std::filesystem::path& folder);
/// Writes results of several people: RESULT/person-K for person K. Removes an earlier run's results
/// of other people, or of one person.
void WritePeople(const std::filesystem::path& folder, const std::map<int, Result>& people);

/// Whether a folder was written by WritePeople. A take of several people is none.
bool IsOfPeople(const std::filesystem::path& folder);
/// Results of people tracked together, with names: person-1, or their own.
using PeopleResults = std::vector<std::pair<std::string, Result>>;
/// Reads such a folder, or a log of MOCAP_PEOPLE and MOCAP_BODIES messages.
/// @param prefix  of a log, as of ReadResult.
/// @throws SetupError  as ReadResult.
PeopleResults ReadPeople(const std::filesystem::path& folder_or_log,
                         const std::optional<std::string>& prefix = {});

/// Reads a folder of WriteResult, or a log of MOCAP_POSE and MOCAP_BODY messages by lcm-logger.
/// @param prefix  in a log, of the channels' names; empty: any, of one daemon.
/// @throws SetupError  when it is neither, or is damaged; names file and line. Says when it is a
/// take, or a result of several people.
Result ReadResult(const std::filesystem::path& folder_or_log,
                  const std::optional<std::string>& prefix = {});

}  // namespace mocap
