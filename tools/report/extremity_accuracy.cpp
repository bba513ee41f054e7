#include "tools/report/extremity_accuracy.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/body/body_model.h"
#include "core/degrees.h"
#include "tools/kinematics/rest_body.h"
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

/// Angle between shank and sole: from the heel to the toe, or from the ankle where the truth has no
/// heel.
double AnkleFlexion(const Vector3& knee_W, const FurtherPoints& further_W, int side,
                    bool has_heel) {
  const auto at = [&](Point point) -> Vector3 {
    return further_W.col(static_cast<int>(point) - kPointCount + side);
  };
  const Vector3 ankle_W = at(Point::kAnkleL);
  return AngleBetween(knee_W - ankle_W,
                      at(Point::kToeL) - (has_heel ? at(Point::kHeelL) : ankle_W));
}

Vector3 TrueKnee(const ScoredPoints& points_W, int side) {
  const auto knee = std::ranges::find(kScoredPoints, Point::kKneeL) - kScoredPoints.begin();
  return points_W.col(knee + side);
}

void AddAnkles(const PoseRow& row, const ScoredFrame& frame, const TrueExtremities& truth,
               ErrorsByName& angles_deg) {
  for (const int side : {0, 1}) {
    const Point heel = side == 0 ? Point::kHeelL : Point::kHeelR;
    const bool has_heel = truth.points_W.col(static_cast<int>(heel) - kPointCount).allFinite();
    const Vector3 knee_W = row.points_W.col(static_cast<int>(Point::kKneeL) + side);
    const double error_rad =
        AnkleFlexion(knee_W, row.further_W, side, has_heel) -
        AnkleFlexion(TrueKnee(frame.points_W, side), truth.points_W, side, has_heel);
    angles_deg.Add(side == 0 ? "ankle_flexion_l" : "ankle_flexion_r",
                   std::abs(error_rad) * kDegreesPerRad);
  }
}

/// Orientations of kTurnedSegmentNames in a result.
class SegmentReader {
 public:
  explicit SegmentReader(const BodyRecord& body)
      : rest_(body), model_(rest_.table(), rest_.sizes()) {}

  /// Empty if the angles are not known.
  std::optional<std::array<Matrix3, 3>> Read(const PoseRow& row) const {
    if (row.joint_rad.size() != model_.joint_count() || !row.joint_rad.allFinite())
      return std::nullopt;
    const Posture posture =
        model_.PostureAt({{TorsoRotation(row), row.paper.torso_mm}, row.joint_rad});
    const auto rotation = [&](Point point) -> Matrix3 {
      const int carrier = model_.CarrierOf(point);
      return carrier < 0 ? posture.X_WT.R : posture.X_W[static_cast<std::size_t>(carrier)].R;
    };
    // Arms hang in the true frames, and are held out in the body's reference.
    return std::array<Matrix3, 3>{rotation(Point::kHead),
                                  rotation(Point::kKnucklesL) * HangingInReference(1),
                                  rotation(Point::kKnucklesR) * HangingInReference(-1)};
  }

 private:
  static Matrix3 HangingInReference(double side) {
    return ExpRotation(side * EIGEN_PI / 2 * Vector3::UnitX());
  }

  RestBody rest_;
  BodyModel model_;
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

void AddSegments(const SegmentReader& reader, const PoseRow& row, const TrueExtremities& truth,
                 ErrorsByName& angles_deg) {
  if (!truth.rotations.allFinite()) return;
  const auto segments = reader.Read(row);
  if (!segments) return;
  const auto error = [&](int i) -> Matrix3 {
    return ExpRotation(truth.rotations.col(i)).transpose() * (*segments)[i];
  };
  AddHead(error(0), angles_deg);
  AddHand(error(1), "_l", angles_deg);
  AddHand(error(2), "_r", angles_deg);
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
  const SegmentReader reader(result.body);
  for (const FrameError& frame : frames) {
    const PoseRow& row = result.poses[static_cast<std::size_t>(frame.pose)];
    const auto at = static_cast<std::size_t>(frame.truth);
    AddPoints(row, truth.extremities[at], points_mm);
    AddAnkles(row, truth.frames[at], truth.extremities[at], angles_deg);
    AddSegments(reader, row, truth.extremities[at], angles_deg);
  }
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
