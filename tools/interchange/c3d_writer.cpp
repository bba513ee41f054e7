#include "tools/interchange/c3d_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/printable_text.h"
#include "tools/interchange/c3d_layout.h"
#include "tools/interchange/c3d_parameters.h"
#include "tools/kinematics/joint_angles.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// Limit of events, from the limit of arrays.
constexpr std::size_t kMostEvents = 255;

/// Names of Vicon's Plug-in Gait: x flexion, y adduction, z internal rotation.
constexpr std::array kAngleNames = {"LHipAngles",   "RHipAngles",      "LKneeAngles",
                                    "RKneeAngles",  "LShoulderAngles", "RShoulderAngles",
                                    "LElbowAngles", "RElbowAngles",    "SpineAngles"};
constexpr int kPointsOfOne = kPointCount + static_cast<int>(kAngleNames.size());

std::array<Vector3, kAngleNames.size()> AnglesIn(const BodyAngles& angles) {
  const auto ball = [](const LimbAngles& limb) {
    return Vector3(limb.flexion, limb.adduction, limb.rotation);
  };
  const auto hinge = [](const LimbAngles& limb) { return Vector3(limb.bend, 0, 0); };
  return {ball(angles.leg_l),  ball(angles.leg_r),  hinge(angles.leg_l),
          hinge(angles.leg_r), ball(angles.arm_l),  ball(angles.arm_r),
          hinge(angles.arm_l), hinge(angles.arm_r), angles.lumbar};
}

/// The fourth number of a point: cameras in the high byte, residual in the low byte.
float QualityOf(const PoseRow& row) {
  const double steps = std::round(row.residual_mm / -kC3dScale);
  return static_cast<float>(256 * row.first_cameras + std::clamp(steps, 0.0, 255.0));
}

void AddPoint(const Vector3& point, float quality, ByteWriter& data) {
  data.AddFloats(point);
  data.Add(quality);
}

/// One subject's points by frame.
class SubjectData {
 public:
  explicit SubjectData(const Result& result) : poses_(result.poses), angles_(AnglesOf(result)) {}

  /// Adds the points at a time; returns whether the person is tracked then. Times increase.
  bool Add(std::int64_t time_ns, ByteWriter& data) {
    while (pose_ < poses_.size() && poses_[pose_].timestamp_ns < time_ns) ++pose_;
    const bool is_tracked =
        pose_ < poses_.size() && poses_[pose_].timestamp_ns == time_ns && IsTracked(poses_[pose_]);
    if (!is_tracked) {
      AddGap(data);
      return false;
    }
    const PoseRow& row = poses_[pose_];
    for (int i = 0; i < kPointCount; ++i) AddPoint(row.points_W.col(i), QualityOf(row), data);
    while (angles_[angle_].time_ns < time_ns) ++angle_;
    for (const Vector3& rad : AnglesIn(angles_[angle_])) {
      AddPoint(rad * kDegreesPerRad, 0, data);
    }
    return true;
  }
  static void AddGap(ByteWriter& data) {
    for (int i = 0; i < kPointsOfOne; ++i) AddPoint(Vector3::Zero(), -1, data);
  }

 private:
  const std::vector<PoseRow>& poses_;
  std::size_t pose_ = 0;
  std::vector<BodyAngles> angles_;
  std::size_t angle_ = 0;
};

/// Collects where tracking of each subject starts and ends.
class EventNotes {
 public:
  explicit EventNotes(std::vector<std::string> subjects)
      : subjects_(std::move(subjects)), last_s_(subjects_.size(), -1) {}

  void Note(std::size_t subject, bool is_tracked, double time_s) {
    const bool was_tracked = last_s_[subject] >= 0;
    if (is_tracked && !was_tracked) Add("Tracking starts", subject, time_s);
    if (!is_tracked && was_tracked) Add("Tracking ends", subject, last_s_[subject]);
    last_s_[subject] = is_tracked ? time_s : -1;
  }
  std::vector<C3dEvent> Take() {
    for (std::size_t i = 0; i < subjects_.size(); ++i) Note(i, false, 0);
    return std::move(events_);
  }

 private:
  void Add(const char* label, std::size_t subject, double time_s) {
    events_.push_back({label, subjects_[subject], time_s});
  }

  std::vector<std::string> subjects_;
  std::vector<double> last_s_;  ///< Time of the last frame if tracked in it; else -1.
  std::vector<C3dEvent> events_;
};

C3dLayout LayoutOf(const ExportScene& scene) {
  C3dLayout layout;
  for (const ExportSubject& subject : scene.subjects) {
    const std::string prefix = scene.LabelPrefix(subject);
    layout.subjects.push_back(subject.name.empty() ? "subject" : Printable(subject.name));
    if (scene.is_of_all) layout.label_prefixes.push_back(prefix);
    for (const std::string_view name : kPointNames)
      layout.labels.push_back(prefix + std::string(name));
    for (const char* name : kAngleNames) {
      layout.labels.push_back(prefix + name);
      layout.angle_labels.push_back(layout.labels.back());
    }
  }
  return layout;
}

}  // namespace

ExportRemarks WriteC3d(const ExportScene& scene, std::ostream& out) {
  const EvenClock clock = FitClock(scene.moments);
  C3dLayout layout = LayoutOf(scene);
  std::vector<SubjectData> subjects;
  for (const ExportSubject& subject : scene.subjects) subjects.emplace_back(subject.result);
  EventNotes notes(layout.subjects);
  ByteWriter data;
  for (std::size_t i = 0; i < scene.moments.size(); ++i) {
    const std::int64_t missing = i == 0 ? 0 : clock.steps[i] - 1;
    RequireShortGap(missing, scene.moments[i]);
    for (std::int64_t k = 0; k < missing; ++k) {
      for (std::size_t s = 0; s < subjects.size(); ++s) SubjectData::AddGap(data);
    }
    layout.frames += missing;
    const double time_s = static_cast<double>(layout.frames) * clock.period_s;
    for (std::size_t s = 0; s < subjects.size(); ++s) {
      const bool is_tracked = subjects[s].Add(scene.moments[i].timestamp_ns, data);
      notes.Note(s, is_tracked, time_s);
    }
    ++layout.frames;
  }
  layout.rate_hz = 1 / clock.period_s;
  layout.events = notes.Take();
  ExportRemarks remarks;
  if (layout.events.size() > kMostEvents) {
    remarks.push_back(fmt::format("starts and ends of tracking: {}, of which C3D can hold {}",
                                  layout.events.size(), kMostEvents));
    layout.events.resize(kMostEvents);
  }
  data.PadTo(kC3dBlock);
  out << C3dBeginning(layout) << data.Take();
  return remarks;
}

}  // namespace mocap
