#include "tools/comparison/ground_pelvis.h"

#include <array>
#include <cmath>

#include "core/degrees.h"
#include "tools/comparison/text_motion.h"
#include "tools/kinematics/euler_angles.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr std::array<std::string_view, 3> kGroundAngles = {"pelvis_tilt", "pelvis_list",
                                                           "pelvis_rotation"};

/// The three angles of a recording.
class GroundPelvis {
 public:
  explicit GroundPelvis(const RecordedMotion& motion) {
    for (std::size_t i = 0; i < 3; ++i) tracks_[i] = motion.FindAngle(kGroundAngles[i]);
  }
  bool IsThere() const { return tracks_[0] && tracks_[1] && tracks_[2]; }
  Vector3 RadAt(const FramePlace& place) const {
    Vector3 rad;
    for (std::size_t i = 0; i < 3; ++i)
      rad[static_cast<Eigen::Index>(i)] = AngleAt(tracks_[i]->deg, place) / kDegreesPerRad;
    return rad;
  }

 private:
  std::array<const AngleCurve*, 3> tracks_{};
};

}  // namespace

bool IsOfGround(std::string_view angle) {
  return std::ranges::find(kGroundAngles, angle) != kGroundAngles.end();
}

void AlignGrounds(const ResultMotion& own, const RecordedMotion& other, Alignment& alignment) {
  const GroundPelvis here(own.motion), there(other);
  if (!here.IsThere() || !there.IsThere()) return;
  double sine = 0, cosine = 0;
  const auto moments = SharedMoments(own.motion, other, alignment.offset_s, 2000);
  for (const SharedMoment& moment : moments) {
    const Matrix3 turn =
        RotationZxy(here.RadAt(moment.own)) * RotationZxy(there.RadAt(moment.other)).transpose();
    if (!turn.allFinite()) continue;
    // Of all turns about y, that with the largest trace of its transpose times the mean.
    sine += turn(0, 2) - turn(2, 0);
    cosine += turn(0, 0) + turn(2, 2);
  }
  const Matrix3 R_GO =
      Eigen::AngleAxisd(std::atan2(sine, cosine), Vector3::UnitY()).toRotationMatrix();
  alignment.X = {YUpFromWorld().transpose() * R_GO, Vector3::Zero()};
  if (alignment.pairs.empty()) return;
  const PointPair& pelvis = alignment.pairs.front();
  Vector3 sum = Vector3::Zero();
  int count = 0;
  for (const SharedMoment& moment : moments) {
    const Vector3 apart =
        PointAt(*pelvis.own, moment.own) - alignment.X.R * PointAt(pelvis.other, moment.other);
    if (!apart.allFinite()) continue;
    sum += apart;
    ++count;
  }
  if (count > 0) alignment.X.p = sum / count;
}

void ToOurGround(const ResultMotion& own, const RigidTransform& X, double offset_s,
                 RecordedMotion& other) {
  const GroundPelvis here(own.motion), there(other);
  if (!here.IsThere() || !there.IsThere()) return;
  const FrameFinder own_frames(own.motion);
  const Matrix3 R_GO = YUpFromWorld() * X.R;
  std::array<std::vector<double>, 3> turned;
  Vector3 last = Vector3::Zero();
  for (std::size_t i = 0; i < other.time_s.size(); ++i) {
    if (const auto place = own_frames.Find(other.time_s[i] + offset_s)) {
      const Vector3 rad = here.RadAt(*place);
      if (rad.allFinite()) last = rad;
    }
    const Vector3 rad = NearestEquivalent(AnglesZxy(R_GO * RotationZxy(there.RadAt({i, 0}))), last);
    if (rad.allFinite()) last = rad;
    for (std::size_t k = 0; k < 3; ++k)
      turned[k].push_back(kDegreesPerRad * rad[static_cast<Eigen::Index>(k)]);
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (AngleCurve& track : other.angles)
      if (track.name == kGroundAngles[k]) track.deg = turned[k];
}

}  // namespace mocap
