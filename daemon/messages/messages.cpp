#include "daemon/messages/messages.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "config/body_size_fields.h"

namespace mocap {
namespace {

constexpr std::int64_t kNsPerUs = 1000;

template <typename From>
void CopyVector(const From& from, double (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

/// Writes run lengths that alternate between empty and occupied, empty first.
class RunWriter {
 public:
  explicit RunWriter(std::vector<std::int32_t>& runs) : runs_(runs) { runs_.assign(1, 0); }

  void Add(bool occupied, int count) {
    if (occupied != occupied_) {
      runs_.push_back(0);
      occupied_ = occupied;
    }
    runs_.back() += count;
  }

 private:
  std::vector<std::int32_t>& runs_;
  bool occupied_ = false;
};

void WriteRuns(const VoxelGrid& grid, std::vector<std::int32_t>& runs) {
  RunWriter writer(runs);
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      const std::uint64_t* row = grid.row(j, k);
      for (int begin = 0; begin < grid.size().x(); begin += 64) {
        const int bits = std::min(64, grid.size().x() - begin);
        const std::uint64_t word = row[begin / 64];
        if (word == 0) {
          writer.Add(false, bits);
        } else {
          for (int bit = 0; bit < bits; ++bit) writer.Add(word >> bit & 1, 1);
        }
      }
    }
  }
}

/// Fields that pose_t and people_t share for a set.
template <typename Message>
void FillSet(const TrackedSet& set, int cameras, Message& message) {
  message.utime = set.capture_ns / kNsPerUs;
  message.complete_utime = set.complete_ns / kNsPerUs;
  message.frame = set.frame;
  message.num_cameras = cameras;
  message.camera_used.resize(cameras);
  for (int i = 0; i < cameras; ++i) message.camera_used[i] = set.cameras >> i & 1;
}

/// Fields that pose_t and person_t share for a person.
template <typename Message>
void FillPerson(const CaptureResult& result, const BodyModel& body, Message& message) {
  const bool has_pose = result.state != CaptureState::kSearching;
  const PaperState paper = has_pose ? body.PaperStateOf(result.pose) : PaperState();
  message.state = static_cast<std::int8_t>(result.state);
  CopyVector(paper.torso_mm, message.torso_mm);
  CopyVector(paper.torso_axis, message.torso_axis);
  message.torso_angle_rad = paper.torso_angle_rad;
  std::ranges::copy(paper.theta_rad, message.theta_rad);
  message.num_joints = body.joint_count();
  message.joint_rad.assign(message.num_joints, 0);
  if (has_pose) std::ranges::copy(result.pose.theta, message.joint_rad.begin());
  for (int i = 0; i < kPointCount; ++i) {
    const Vector3 p_WQ = has_pose ? Vector3(result.points_W.col(i)) : Vector3::Zero();
    CopyVector(p_WQ, message.point_mm[i]);
    message.point_std_mm[i] = has_pose ? result.point_std_mm[i] : 0;
  }
  message.residual_mm = has_pose ? result.residual_mm : 0;
  message.voxels = result.voxels;
}

template <typename Column>
void AssignPoint(const Column& p_W, std::vector<double>& to_mm) {
  to_mm.assign({p_W[0], p_W[1], p_W[2]});
}

void FillPoints(const CaptureResult& result, bool has_pose, person_details_t& message) {
  const int count = has_pose ? kPlaceCount : 0;
  message.num_points = count;
  message.point_name.resize(count);
  message.point_mm.resize(count);
  message.point_std_mm.resize(count);
  for (int i = 0; i < std::min(count, kPointCount); ++i) {
    message.point_name[i] = kPointNames[i];
    AssignPoint(result.points_W.col(i), message.point_mm[i]);
    message.point_std_mm[i] = result.point_std_mm[i];
  }
  for (int i = kPointCount; i < count; ++i) {
    message.point_name[i] = kFurtherPointNames[i - kPointCount];
    AssignPoint(result.further_W.col(i - kPointCount), message.point_mm[i]);
    message.point_std_mm[i] = result.further_std_mm[i - kPointCount];
  }
}

void FillJoints(const CaptureResult& result, const BodyTable& table, int count,
                person_details_t& message) {
  message.num_joints = count;
  message.joint_name.resize(count);
  message.joint_rad.resize(count);
  message.joint_std_rad.assign(count, std::nan(""));
  for (int i = 0; i < count; ++i) {
    message.joint_name[i] = table.joints[i].name;
    message.joint_rad[i] = result.pose.theta[i];
    if (i < result.joint_std_rad.size()) message.joint_std_rad[i] = result.joint_std_rad[i];
  }
}

void FillContacts(const CaptureResult& result, bool has_pose, person_details_t& message) {
  const int count = has_pose && result.contacts.allFinite() ? kContactCount : 0;
  message.num_contacts = count;
  message.contact_name.assign(kContactNames.begin(), kContactNames.begin() + count);
  message.contact.assign(result.contacts.begin(), result.contacts.begin() + count);
}

}  // namespace

void FillPose(const TrackedSet& set, int cameras, pose_t& message) {
  FillSet(set, cameras, message);
  FillPerson(set.result, set.body, message);
}

void FillPeople(const TrackedSet& set, int cameras, people_t& message) {
  FillSet(set, cameras, message);
  message.num_people = static_cast<std::int32_t>(set.people.size());
  message.people.resize(set.people.size());
  for (std::size_t i = 0; i < set.people.size(); ++i) {
    message.people[i].id = set.people[i].id;
    message.people[i].name = set.people[i].name;
    FillPerson(set.people[i].capture->result(), set.people[i].capture->body(), message.people[i]);
  }
}

void FillDetails(const TrackedSet& set, std::size_t place, person_details_t& message) {
  const CaptureResult& result = set.people[place].capture->result();
  const BodyModel& body = set.people[place].capture->body();
  const bool has_pose = result.state != CaptureState::kSearching;
  const bool has_rival = has_pose && result.rival;
  message.utime = set.capture_ns / kNsPerUs;
  message.frame = set.frame;
  message.person = set.people[place].id;
  message.place = static_cast<std::int32_t>(place);
  message.state = static_cast<std::int8_t>(result.state);
  message.probability = has_pose ? result.probability.value_or(std::nan("")) : std::nan("");
  FillPoints(result, has_pose, message);
  FillJoints(result, body.table(), has_pose ? body.joint_count() : 0, message);
  FillContacts(result, has_pose, message);
  message.rival_probability = has_rival ? result.rival->probability : 0;
  message.num_rival_points = has_rival ? kPointCount : 0;
  message.rival_point_mm.resize(message.num_rival_points);
  for (int i = 0; i < message.num_rival_points; ++i)
    AssignPoint(result.rival->points_W.col(i), message.rival_point_mm[i]);
}

void FillBody(const BodyModel& body, std::int64_t utime, body_t& message) {
  message.utime = utime;
  message.model = body.table().name;
  message.stature_mm = body.sizes().Stature();
  for (int i = 0; i < kPointCount; ++i) {
    message.point_name[i] = kPointNames[i];
    message.point_carrier[i] = body.CarrierOf(static_cast<Point>(i));
    CopyVector(body.reference_points_T().col(i), message.point_reference_mm[i]);
  }
  const std::vector<JointAxis>& joints = body.table().joints;
  message.num_joints = body.joint_count();
  message.joint_name.resize(joints.size());
  message.joint_parent.resize(joints.size());
  message.joint_axis.assign(joints.size(), std::vector<double>(3));
  message.joint_place_mm.assign(joints.size(), std::vector<double>(3));
  message.joint_min_rad.resize(joints.size());
  message.joint_max_rad.resize(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    message.joint_name[i] = joints[i].name;
    message.joint_parent[i] = joints[i].parent;
    std::ranges::copy(joints[i].axis_T, message.joint_axis[i].begin());
    std::ranges::copy(body.reference_points_T().col(static_cast<int>(joints[i].at)),
                      message.joint_place_mm[i].begin());
    message.joint_min_rad[i] = joints[i].min_rad;
    message.joint_max_rad[i] = joints[i].max_rad;
  }
  message.num_sizes = static_cast<std::int32_t>(kBodySizeFields.size());
  message.size_name.clear();
  message.size_mm.clear();
  for (const BodySizeField& field : kBodySizeFields) {
    message.size_name.emplace_back(field.name);
    message.size_mm.push_back(body.sizes().*field.value);
  }
}

void FillVoxelGrid(const VoxelGrid& grid, std::int64_t capture_ns, std::int64_t frame,
                   voxels_t& message) {
  message.utime = capture_ns / kNsPerUs;
  message.frame = frame;
  CopyVector(grid.origin_W(), message.origin_mm);
  message.voxel_mm = grid.voxel_mm();
  for (int axis = 0; axis < 3; ++axis) message.size[axis] = grid.size()[axis];
  WriteRuns(grid, message.run);
  message.num_runs = static_cast<std::int32_t>(message.run.size());
  message.label.clear();
  message.num_labels = 0;
}

void FillVoxels(const VoxelGrid& grid, std::int64_t capture_ns, std::int64_t frame,
                std::span<const BodyInPlace> bodies, voxels_t& message) {
  FillVoxelGrid(grid, capture_ns, frame, message);
  if (!bodies.empty()) LabelForViewers(grid, bodies, message.label);
  message.num_labels = static_cast<std::int32_t>(message.label.size());
}

void FillVoxels(const TrackedSet& set, voxels_t& message) {
  std::vector<BodyInPlace> bodies;
  if (set.people.empty() && set.result.state != CaptureState::kSearching) {
    bodies.push_back({set.body, set.result.pose});
  }
  for (const PersonView& person : set.people) {
    bodies.push_back({person.capture->body(), person.capture->result().pose});
  }
  FillVoxels(set.grid, set.capture_ns, set.frame, bodies, message);
}

}  // namespace mocap
