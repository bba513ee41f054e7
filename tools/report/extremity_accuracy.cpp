#include "tools/report/extremity_accuracy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/degrees.h"
#include "tools/kinematics/posed_segments.h"
#include "tools/report/foot_contacts.h"

namespace mocap {
namespace {

/// Errors by name, in the order in which names come up first.
class ErrorsByName {
 public:
  void Add(const std::string& name, double error) {
    if (std::isnan(error)) return;
    const auto found = std::ranges::find(lists_, name, &Named::first);
    (found != lists_.end() ? found->second
                           : lists_.emplace_back(name, std::vector<double>()).second)
        .push_back(error);
  }

  std::vector<FigureErrors> Summary() const {
    std::vector<FigureErrors> figures;
    for (const auto& [name, errors] : lists_) {
      const DistanceSummary summary = SummarizeDistances(errors);
      figures.push_back({name, summary.mean, summary.p95});
    }
    return figures;
  }

 private:
  using Named = std::pair<std::string, std::vector<double>>;
  std::vector<Named> lists_;
};

double AngleBetween(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Point OnSide(Point left, int side) { return static_cast<Point>(static_cast<int>(left) + side); }

/// Angle between shank and sole, from the heel to the toe. Where the truth has no heel, from the
/// ankle: then it also depends on where in the foot its toe lies.
double AnkleFlexion(const Vector3& knee_W, const FurtherPoints& further_W, int side,
                    bool has_heel) {
  const auto at = [&](Point point) -> Vector3 { return FurtherOf(further_W, OnSide(point, side)); };
  const Vector3 ankle_W = at(Point::kAnkleL);
  return AngleBetween(knee_W - ankle_W,
                      at(Point::kToeL) - (has_heel ? at(Point::kHeelL) : ankle_W));
}

Vector3 TrueKnee(const ScoredPoints& points_W, int side) {
  const auto knee = std::ranges::find(kScoredPoints, Point::kKneeL) - kScoredPoints.begin();
  return points_W.col(knee + side);
}

/// Errors of one ankle.
class AnkleErrors {
 public:
  void Add(const PoseRow& row, const ScoredFrame& frame, const TrueExtremities& truth, int side) {
    has_heel_ = FurtherOf(truth.points_W, OnSide(Point::kHeelL, side)).allFinite();
    const Vector3 knee_W = At(row, OnSide(Point::kKneeL, side));
    const double error_rad =
        AnkleFlexion(knee_W, row.further_W, side, has_heel_) -
        AnkleFlexion(TrueKnee(frame.points_W, side), truth.points_W, side, has_heel_);
    if (!std::isnan(error_rad)) errors_deg_.push_back(error_rad * kDegreesPerRad);
  }

  void AddTo(const std::string& name, ErrorsByName& angles_deg) const {
    const double sum = std::accumulate(errors_deg_.begin(), errors_deg_.end(), 0.0);
    const double offset =
        has_heel_ || errors_deg_.empty() ? 0 : sum / static_cast<double>(errors_deg_.size());
    for (const double error : errors_deg_) angles_deg.Add(name, std::abs(error - offset));
  }

 private:
  std::vector<double> errors_deg_;
  bool has_heel_ = false;
};

void AddHead(const Matrix3& R_error, ErrorsByName& angles_deg) {
  const Vector3 turn_deg = LogRotation(R_error) * kDegreesPerRad;
  angles_deg.Add("head_yaw", std::abs(turn_deg.z()));
  angles_deg.Add("head_pitch", std::abs(turn_deg.y()));
  angles_deg.Add("head_roll", std::abs(turn_deg.x()));
}

void AddHand(const Matrix3& R_error, const std::string& side, ErrorsByName& angles_deg) {
  angles_deg.Add("hand_direction" + side,
                 AngleBetween(R_error.col(2), Vector3::UnitZ()) * kDegreesPerRad);
  // The turn about z that is nearest to the error.
  const double turn_rad = std::atan2(R_error(1, 0) - R_error(0, 1), R_error(0, 0) + R_error(1, 1));
  angles_deg.Add("hand_turn" + side, std::abs(turn_rad) * kDegreesPerRad);
}

/// Whether a body has the joint by which the head turns about its length.
bool TurnsHead(const BodyRecord& body) {
  return std::ranges::find(body.joints, "neck_z", &JointRecord::name) != body.joints.end();
}

void AddSegments(const SegmentPoser& segments, bool turns_head, const PoseRow& row,
                 const TrueExtremities& truth, ErrorsByName& angles_deg) {
  const bool has_angles = row.joint_rad.size() > 0 && row.joint_rad.allFinite();
  if (!truth.rotations.allFinite() || !has_angles) return;
  const PosedSegments posed = segments.Pose(row);
  const auto error = [&](int i, Segment segment) -> Matrix3 {
    return ExpRotation(truth.rotations.col(i)).transpose() * posed.RotationFromHanging(segment);
  };
  const auto has_hand = [&](Point knuckles) {
    return FurtherOf(row.further_W, knuckles).allFinite();
  };
  if (turns_head) AddHead(error(0, Segment::kHead), angles_deg);
  if (has_hand(Point::kKnucklesL)) AddHand(error(1, Segment::kHandL), "_l", angles_deg);
  if (has_hand(Point::kKnucklesR)) AddHand(error(2, Segment::kHandR), "_r", angles_deg);
}

void AddPoints(const PoseRow& row, const TrueExtremities& truth, ErrorsByName& points_mm) {
  for (int i = 0; i < kFurtherPointCount; ++i)
    points_mm.Add(std::string(kFurtherPointNames[i]),
                  (row.further_W.col(i) - truth.points_W.col(i)).norm());
}

/// Averages errors of the same name.
std::vector<FigureErrors> MeansByName(std::span<const ExtremityAccuracy> takes,
                                      std::vector<FigureErrors> ExtremityAccuracy::*figures) {
  std::vector<FigureErrors> sums;
  std::vector<int> counts;
  for (const ExtremityAccuracy& take : takes) {
    for (const FigureErrors& one : take.*figures) {
      const auto place = std::ranges::find(sums, one.name, &FigureErrors::name) - sums.begin();
      if (place == std::ssize(sums)) {
        sums.push_back({one.name, 0, 0});
        counts.push_back(0);
      }
      sums[place].mean += one.mean;
      sums[place].p95 += one.p95;
      ++counts[place];
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i].mean /= counts[i];
    sums[i].p95 /= counts[i];
  }
  return sums;
}

Skating MeanSkating(std::span<const ExtremityAccuracy> takes,
                    std::array<Skating, 2> ExtremityAccuracy::*skating, std::size_t part) {
  Skating mean;
  int count = 0;
  for (const ExtremityAccuracy& take : takes) {
    const Skating& one = (take.*skating)[part];
    if (one.stances == 0) continue;
    ++count;
    mean.stances += one.stances;
    mean.frame_p95_mm += one.frame_p95_mm;
    mean.stance_mean_mm += one.stance_mean_mm;
    mean.stance_p95_mm += one.stance_p95_mm;
  }
  if (count == 0) return mean;
  mean.frame_p95_mm /= count;
  mean.stance_mean_mm /= count;
  mean.stance_p95_mm /= count;
  return mean;
}

}  // namespace

ExtremityAccuracy MeasureExtremities(const Result& result, const TakeTruth& truth,
                                     std::span<const FrameError> frames) {
  ExtremityAccuracy accuracy;
  if (truth.extremities.empty() || frames.empty()) return accuracy;
  ErrorsByName points_mm, angles_deg;
  std::array<AnkleErrors, 2> ankles;
  const SegmentPoser segments(result.body);
  const bool turns_head = TurnsHead(result.body);
  for (const FrameError& frame : frames) {
    const PoseRow& row = result.poses[static_cast<std::size_t>(frame.pose)];
    const auto at = static_cast<std::size_t>(frame.truth);
    AddPoints(row, truth.extremities[at], points_mm);
    for (const int side : {0, 1})
      ankles[side].Add(row, truth.frames[at], truth.extremities[at], side);
    AddSegments(segments, turns_head, row, truth.extremities[at], angles_deg);
  }
  ankles[0].AddTo("ankle_flexion_l", angles_deg);
  ankles[1].AddTo("ankle_flexion_r", angles_deg);
  accuracy.points_mm = points_mm.Summary();
  accuracy.angles_deg = angles_deg.Summary();
  MeasureContacts(result, truth, frames, accuracy);
  return accuracy;
}

ExtremityAccuracy MeanOf(std::span<const ExtremityAccuracy> takes) {
  ExtremityAccuracy mean;
  mean.points_mm = MeansByName(takes, &ExtremityAccuracy::points_mm);
  mean.angles_deg = MeansByName(takes, &ExtremityAccuracy::angles_deg);
  for (std::size_t part = 0; part < kFootPartNames.size(); ++part) {
    for (const ExtremityAccuracy& take : takes) {
      mean.contacts[part].hits += take.contacts[part].hits;
      mean.contacts[part].false_alarms += take.contacts[part].false_alarms;
      mean.contacts[part].misses += take.contacts[part].misses;
    }
    mean.skating[part] = MeanSkating(takes, &ExtremityAccuracy::skating, part);
    mean.true_skating[part] = MeanSkating(takes, &ExtremityAccuracy::true_skating, part);
  }
  return mean;
}

}  // namespace mocap
