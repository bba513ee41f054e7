#include "tools/interchange/c3d_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/printable_text.h"
#include "tools/interchange/c3d_events.h"
#include "tools/interchange/c3d_layout.h"
#include "tools/interchange/c3d_parameters.h"
#include "tools/interchange/c3d_points.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// Limit of events, from the limit of arrays.
constexpr std::size_t kMostEvents = 255;

/// The fourth number of a point: cameras in the high byte, residual in the low byte.
float QualityOf(const PoseRow& row) {
  const double steps = std::round(row.residual_mm / -kC3dScale);
  return static_cast<float>(256 * row.first_cameras + std::clamp(steps, 0.0, 255.0));
}

void AddMissingPoint(ByteWriter& data) {
  data.AddFloats(Vector3(Vector3::Zero()));
  data.Add(-1.0f);
}

/// @param point  NaN: not known.
void AddPoint(const Vector3& point, float quality, ByteWriter& data) {
  if (!point.allFinite()) return AddMissingPoint(data);
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
    for (const C3dMarker& marker : kC3dMarkers)
      AddPoint(FurtherOf(row.further_W, marker.point), QualityOf(row), data);
    while (angles_[angle_].time_ns < time_ns) ++angle_;
    for (const Vector3& rad : C3dAnglesOf(angles_[angle_])) {
      AddPoint(rad * kDegreesPerRad, 0, data);
    }
    return true;
  }
  static void AddGap(ByteWriter& data) {
    for (std::size_t i = 0; i < kC3dPointCount; ++i) AddMissingPoint(data);
  }

 private:
  const std::vector<PoseRow>& poses_;
  std::size_t pose_ = 0;
  std::vector<BodyAngles> angles_;
  std::size_t angle_ = 0;
};

C3dLayout LayoutOf(const ExportScene& scene) {
  C3dLayout layout;
  for (const ExportSubject& subject : scene.subjects) {
    const std::string prefix = scene.LabelPrefix(subject);
    layout.subjects.push_back(subject.name.empty() ? "subject" : Printable(subject.name));
    if (scene.is_of_all) layout.label_prefixes.push_back(prefix);
    for (const std::string_view name : kPointNames)
      layout.labels.push_back(prefix + std::string(name));
    for (const C3dMarker& marker : kC3dMarkers)
      layout.labels.push_back(prefix + std::string(marker.name));
    for (const std::string_view name : kC3dAngleNames) {
      layout.labels.push_back(prefix + std::string(name));
      layout.angle_labels.push_back(layout.labels.back());
    }
  }
  layout.filter = scene.subjects.front().result.filter.value_or("");
  return layout;
}

}  // namespace

ExportRemarks WriteC3d(const ExportScene& scene, std::ostream& out) {
  const EvenClock clock = FitClock(scene.moments);
  C3dLayout layout = LayoutOf(scene);
  std::vector<SubjectData> subjects;
  for (const ExportSubject& subject : scene.subjects) subjects.emplace_back(subject.result);
  C3dEvents events(layout.subjects);
  C3dClock file_clock;
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
      events.Note(s, is_tracked, time_s);
    }
    file_clock.capture_ns.push_back(scene.moments[i].timestamp_ns);
    file_clock.file_s.push_back(time_s);
    ++layout.frames;
  }
  layout.rate_hz = 1 / clock.period_s;
  for (std::size_t s = 0; s < subjects.size(); ++s)
    events.NoteSteps(s, scene.subjects[s].result, file_clock);
  layout.events = events.Take();
  ExportRemarks remarks;
  if (layout.events.size() > kMostEvents) {
    remarks.push_back(fmt::format("events: {}, of which C3D can hold the first {}",
                                  layout.events.size(), kMostEvents));
    layout.events.resize(kMostEvents);
  }
  data.PadTo(kC3dBlock);
  out << C3dBeginning(layout) << data.Take();
  return remarks;
}

}  // namespace mocap
