#include "core/calibration/studio_diagnosis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/calibration/person_extent.h"
#include "core/calibration/view_agreement.h"
#include "core/quantile.h"

namespace mocap {
namespace {

/// Of the direction to the middle of what is seen. At 5 m, 0.05 m.
constexpr double kLeastMotion_rad = 0.01;
/// Calibrated pairs of recorded and rendered takes have 0.91 and more; docs/experiments/cameras.md.
constexpr double kLeastAgreement = 0.85;
/// Of all pairs that can be compared: something may stand before one camera.
constexpr double kLeastPairs = 0.9;
constexpr int kFewestMoments = 3;

/// From somebody who crouches or sits to a tall man with raised arms.
constexpr double kShortest_mm = 1000, kTallest_mm = 2600;
/// Twice of what the feet of one person seem to be off a right floor; docs/experiments/cameras.md.
constexpr double kMostOffFloor_mm = 100;
/// Metres, feet, inches and centimetres. Hardly any height of a person fits two of them.
constexpr std::array kUnits_mm = {1000.0, 304.8, 25.4, 10.0};

/// Changes of a picture that cameras or their drivers make.
enum class Flip { kNone, kRotated, kMirrored };

/// How the pictures are assigned to the calibrations.
struct Arrangement {
  std::vector<std::size_t> calibration;  ///< Of each picture.
  std::vector<Flip> flip;                ///< Of each picture.

  explicit Arrangement(std::size_t cameras) : calibration(cameras), flip(cameras, Flip::kNone) {
    std::iota(calibration.begin(), calibration.end(), std::size_t{0});
  }
};

SeenShape Flipped(SeenShape shape, Flip flip, const CameraCalibration& camera) {
  if (flip == Flip::kNone) return shape;
  for (Vector2& corner : shape.rim_px) {
    corner.x() = camera.width_px - 1 - corner.x();
    if (flip == Flip::kRotated) corner.y() = camera.height_px - 1 - corner.y();
  }
  return shape;
}

bool IsStature(double mm) { return mm >= kShortest_mm && mm <= kTallest_mm; }

void JudgeExtent(StudioDiagnosis& diagnosis) {
  const PersonExtent& person = diagnosis.person;
  if (person.moments < kFewestMoments) return;
  const double height_mm = person.highest_mm - person.lowest_mm;
  if (IsStature(height_mm)) {
    if (std::abs(person.lowest_mm) > kMostOffFloor_mm) diagnosis.fault = StudioFault::kFloor;
    return;
  }
  diagnosis.fault = StudioFault::kStature;
  for (const double unit_mm : kUnits_mm) {
    if (!IsStature(unit_mm * height_mm)) continue;
    diagnosis.fault = StudioFault::kUnit;
    diagnosis.unit_mm = unit_mm;
  }
}

/// What one picture shows at all moments, as rays; empty where it shows nobody.
using Cones = std::vector<std::optional<SeenCone>>;

class Examination {
 public:
  Examination(std::span<const CameraCalibration> cameras, std::span<const SeenMoment> moments)
      : cameras_(cameras), moments_(moments), as_is_(cameras.size()) {
    for (std::size_t c = 0; c < cameras.size(); ++c) cones_.push_back(ConesOf(as_is_, c));
  }

  StudioDiagnosis Conclude() {
    StudioDiagnosis diagnosis;
    diagnosis.pairs = PairsOf(cones_, as_is_.calibration);
    std::vector<std::size_t> agreeing = as_is_.calibration;
    if (!Agree(diagnosis.pairs)) {
      if (CountCompared(diagnosis.pairs) == 0 || FindRearrangement(diagnosis)) return diagnosis;
      if (SeeDifferentPeople(diagnosis.pairs)) return diagnosis;
      agreeing = WithoutThoseThatDisagree(diagnosis);
      if (diagnosis.fault == StudioFault::kNoneAgree) return diagnosis;
    }
    diagnosis.person = MeasureExtent(cameras_, moments_, agreeing);
    if (diagnosis.fault == StudioFault::kNone && CountCompared(diagnosis.pairs) > 0) {
      JudgeExtent(diagnosis);
    }
    return diagnosis;
  }

 private:
  Cones ConesOf(const Arrangement& arrangement, std::size_t picture) const {
    const std::size_t calibration = arrangement.calibration[picture];
    const CameraCalibration& camera = cameras_[calibration];
    Cones cones;
    for (const SeenMoment& moment : moments_) {
      cones.emplace_back();
      if (!moment[picture] || !moment[calibration]) continue;
      if (moment[picture]->height_share < kLeastPersonShare) continue;
      cones.back() = ConeOf(Flipped(*moment[picture], arrangement.flip[picture], camera),
                            camera.lens, moment[calibration]->X_CW);
    }
    return cones;
  }

  /// Compares the pairs that contain one of these cameras.
  static std::vector<PairAgreement> PairsOf(const std::vector<Cones>& cones,
                                            const std::vector<std::size_t>& of) {
    std::vector<PairAgreement> pairs;
    for (std::size_t a = 0; a < cones.size(); ++a) {
      for (std::size_t b = a + 1; b < cones.size(); ++b) {
        if (std::ranges::count(of, a) + std::ranges::count(of, b) == 0) continue;
        pairs.push_back(Compare(cones[a], cones[b]));
        pairs.back().first = a;
        pairs.back().second = b;
      }
    }
    return pairs;
  }

  static PairAgreement Compare(const Cones& a, const Cones& b) {
    std::vector<double> overlaps, contained;
    for (std::size_t m = 0; m < a.size(); ++m) {
      const auto agreement = a[m] && b[m] ? AgreementOf(*a[m], *b[m]) : std::nullopt;
      if (!agreement) continue;
      overlaps.push_back(agreement->overlap);
      contained.push_back(agreement->contained);
    }
    PairAgreement pair;
    pair.moments = static_cast<int>(overlaps.size());
    if (pair.moments > 0) pair.views = {MedianOf(overlaps), MedianOf(contained)};
    return pair;
  }

  static bool IsCompared(const PairAgreement& pair) { return pair.moments >= kFewestMoments; }
  static bool Agrees(const PairAgreement& pair) { return pair.views.overlap >= kLeastAgreement; }
  static std::ptrdiff_t CountCompared(const std::vector<PairAgreement>& pairs) {
    return std::ranges::count_if(pairs, IsCompared);
  }

  /// Some cameras may show fewer of several people than others.
  static bool SeeDifferentPeople(const std::vector<PairAgreement>& pairs) {
    const auto is_contained = [](const PairAgreement& pair) {
      return IsCompared(pair) && pair.views.contained >= kLeastAgreement;
    };
    return static_cast<double>(std::ranges::count_if(pairs, is_contained)) >=
           kLeastPairs * static_cast<double>(CountCompared(pairs));
  }

  static bool Agree(const std::vector<PairAgreement>& pairs) {
    int compared = 0, agreeing = 0;
    for (const PairAgreement& pair : pairs) {
      compared += IsCompared(pair);
      agreeing += IsCompared(pair) && Agrees(pair);
    }
    return compared > 0 && agreeing >= kLeastPairs * compared;
  }

  static double MeanOf(const std::vector<PairAgreement>& pairs) {
    double sum = 0;
    for (const PairAgreement& pair : pairs) sum += IsCompared(pair) ? pair.views.overlap : 0;
    return sum / static_cast<double>(std::max<std::ptrdiff_t>(1, CountCompared(pairs)));
  }

  /// Tries the changes that one mistake makes; takes the one with which the views agree best.
  bool FindRearrangement(StudioDiagnosis& diagnosis) const {
    double best = 0;
    const auto attempt = [&](StudioFault fault, const Arrangement& arrangement,
                             const std::vector<std::size_t>& changed) {
      const double agreement = AgreementWith(arrangement, changed, diagnosis.pairs);
      if (agreement <= best) return;
      best = agreement;
      diagnosis.fault = fault;
      diagnosis.cameras = changed;
    };
    for (std::size_t a = 0; a < cameras_.size(); ++a) {
      for (const auto& [flip, fault] : {std::pair(Flip::kRotated, StudioFault::kUpsideDown),
                                        std::pair(Flip::kMirrored, StudioFault::kMirrored)}) {
        Arrangement flipped = as_is_;
        flipped.flip[a] = flip;
        attempt(fault, flipped, {a});
      }
      for (std::size_t b = a + 1; b < cameras_.size(); ++b) {
        const bool is_possible = cameras_[a].width_px == cameras_[b].width_px &&
                                 cameras_[a].height_px == cameras_[b].height_px;
        if (!is_possible) continue;
        Arrangement exchanged = as_is_;
        std::swap(exchanged.calibration[a], exchanged.calibration[b]);
        attempt(StudioFault::kExchanged, exchanged, {a, b});
      }
    }
    return diagnosis.fault != StudioFault::kNone;
  }

  /// Mean agreement of the changed cameras with all others; 0 if anybody disagrees then.
  /// @param as_is  all pairs without the change.
  double AgreementWith(const Arrangement& arrangement, const std::vector<std::size_t>& changed,
                       const std::vector<PairAgreement>& as_is) const {
    std::vector<Cones> cones = cones_;
    for (const std::size_t c : changed) cones[c] = ConesOf(arrangement, c);
    std::vector<PairAgreement> pairs = PairsOf(cones, changed);
    // One pair alone agrees by several changes.
    if (CountCompared(pairs) < 2 || !Agree(pairs)) return 0;
    const double agreement = MeanOf(pairs);
    for (const PairAgreement& pair : as_is) {
      const bool is_changed = std::ranges::count(changed, pair.first) > 0 ||
                              std::ranges::count(changed, pair.second) > 0;
      if (!is_changed) pairs.push_back(pair);
    }
    return Agree(pairs) ? agreement : 0;
  }

  /// Leaves out one camera after the other until the rest agrees.
  /// @return  the rest.
  std::vector<std::size_t> WithoutThoseThatDisagree(StudioDiagnosis& diagnosis) const {
    std::vector<std::size_t> rest = as_is_.calibration;
    std::vector<PairAgreement> pairs = diagnosis.pairs;
    while (!Agree(pairs) && rest.size() > 2) {
      const std::size_t worst = WorstIn(rest, pairs);
      diagnosis.cameras.push_back(worst);
      std::erase(rest, worst);
      std::erase_if(pairs, [worst](const PairAgreement& pair) {
        return pair.first == worst || pair.second == worst;
      });
    }
    std::ranges::sort(diagnosis.cameras);
    const bool is_majority = Agree(pairs) && rest.size() > diagnosis.cameras.size();
    diagnosis.fault = is_majority ? StudioFault::kSomeDisagree : StudioFault::kNoneAgree;
    if (!is_majority) diagnosis.cameras.clear();
    return rest;
  }

  static std::size_t WorstIn(const std::vector<std::size_t>& rest,
                             const std::vector<PairAgreement>& pairs) {
    const auto mean_of = [&pairs](std::size_t camera) {
      std::vector<PairAgreement> its;
      for (const PairAgreement& pair : pairs)
        if (pair.first == camera || pair.second == camera) its.push_back(pair);
      return CountCompared(its) == 0 ? 1.0 : MeanOf(its);
    };
    return *std::ranges::min_element(rest, {}, mean_of);
  }

  const std::span<const CameraCalibration> cameras_;
  const std::span<const SeenMoment> moments_;
  const Arrangement as_is_;
  std::vector<Cones> cones_;  ///< Of each picture, as the cameras are calibrated.
};

/// Where the middle of what a camera shows lies; empty if it shows nobody.
std::optional<Vector3> MiddleRay(const std::optional<SeenShape>& shape, const Lens& lens) {
  if (!shape || shape->rim_px.empty()) return {};
  Eigen::AlignedBox2d box;
  for (const Vector2& corner : shape->rim_px) box.extend(corner);
  const auto n = NormalizedFromPixel(lens, box.center());
  if (!n) return {};
  return Vector3(shape->X_CW.R.transpose() * n->homogeneous().normalized());
}

}  // namespace

bool ShowsPerson(const SeenMoment& moment) {
  std::size_t there = 0, show = 0;
  for (const auto& shape : moment) {
    there += shape.has_value();
    show += shape && shape->height_share >= kLeastPersonShare;
  }
  return show >= 2 && 2 * show > there;
}

bool Moves(std::span<const CameraCalibration> cameras, std::span<const SeenMoment> moments) {
  std::size_t there = 0, moving = 0;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    std::vector<Vector3> rays;
    for (const SeenMoment& moment : moments)
      if (const auto ray = MiddleRay(moment[c], cameras[c].lens)) rays.push_back(*ray);
    if (rays.empty()) continue;
    ++there;
    moving += std::ranges::any_of(rays, [&](const Vector3& ray) {
      return ray.cross(rays.front()).norm() >= kLeastMotion_rad;
    });
  }
  return 2 * moving > there;
}

bool IsOfCameras(StudioFault fault) {
  return fault == StudioFault::kExchanged || fault == StudioFault::kUpsideDown ||
         fault == StudioFault::kMirrored || fault == StudioFault::kSomeDisagree;
}

StudioDiagnosis Diagnose(std::span<const CameraCalibration> cameras,
                         std::span<const SeenMoment> moments) {
  return Examination(cameras, moments).Conclude();
}

}  // namespace mocap
