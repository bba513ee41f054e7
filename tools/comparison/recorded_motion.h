// Motion of one person as any system recorded it: points and angles over time.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace mocap {

inline constexpr double kMmPerMetre = 1000;

/// What was not seen or measured.
inline constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();
inline Vector3 Unseen() { return Vector3::Constant(kUnmeasured); }

/// A point's places over time; NaN: not seen.
struct PointTrack {
  std::string name;
  std::vector<Vector3> p_mm;
};

/// An angle over time; NaN: not known.
struct AngleCurve {
  std::string name;
  std::vector<double> deg;
};

/// A joint of a skeleton file.
struct JointTrack {
  std::string name;
  Vector3 bone = Vector3::Zero();  ///< To the first child, in the joint's own axes; any unit.
  std::vector<Matrix3> R;          ///< From joint to parent.
};

struct RecordedMotion {
  std::string subject;         ///< Of a file of several; else empty.
  std::vector<double> time_s;  ///< Increasing.
  std::vector<PointTrack> points;
  std::vector<AngleCurve> angles;
  std::vector<JointTrack> joints;  ///< Of skeleton files.
  /// Whether lengths are millimetres. Some files do not state a unit.
  bool has_unit = true;

  const PointTrack* FindPoint(std::string_view name) const;
  const AngleCurve* FindAngle(std::string_view name) const;
  /// Median time between frames [s]; 0 for fewer than two.
  double Period() const;
  double Seconds() const { return time_s.empty() ? 0 : time_s.back() - time_s.front(); }
};

/// What a file has, and what was noticed in it.
struct MotionFile {
  std::string format;  ///< "C3D".
  std::vector<RecordedMotion> subjects;
  std::vector<std::string> remarks;
};

/// Between which frames a moment lies.
struct FramePlace {
  std::size_t before = 0;
  double share = 0;  ///< Of the way to the next frame, 0 to below 1.
};

/// The frame nearest to a place.
inline std::size_t NearestFrame(const FramePlace& place) {
  return place.before + (place.share >= 0.5 ? 1 : 0);
}

/// Finds moments among the frames of a recording. A gap in its frames has no moments.
class FrameFinder {
 public:
  /// @param motion  not owned.
  explicit FrameFinder(const RecordedMotion& motion);

  /// @return  empty outside of the recording and in gaps.
  std::optional<FramePlace> Find(double time_s) const;

 private:
  const RecordedMotion& motion_;
  double longest_s_;  ///< Frames farther apart have a gap between them.
};

/// A point between frames, by the cubic through four of them where all are seen, and else by the
/// line through two. @return  NaN where a needed frame does not see it.
Vector3 PointAt(const std::vector<Vector3>& track, const FramePlace& place);
/// An angle between frames, by the line. @return  NaN where a needed frame does not know it.
double AngleAt(const std::vector<double>& track, const FramePlace& place);

/// One coordinate of points.
std::vector<double> AxisOf(const std::vector<Vector3>& points, int axis);

/// Removes jumps by whole turns, also across unknown values.
void Unwrap(std::vector<double>& deg);

/// Scales lengths without a unit to millimetres: of the units in use, that in which the points
/// are spread most like those of somebody else. @return  the unit's name.
std::string_view ScaleLike(const RecordedMotion& other, RecordedMotion& motion);

/// Millimetres of "mm", "cm", "m", "in" and the like, in any case; empty if unknown.
std::optional<double> UnitInMm(std::string_view unit);

}  // namespace mocap
