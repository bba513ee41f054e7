#include "core/tracking/limb_recovery.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/body/stance.h"
#include "core/tracking/limb_search.h"

namespace mocap {
namespace {

constexpr int kVoxels = 150;
constexpr int kEdges = 600;
constexpr double kReachMm = 150;
constexpr double kUnexplainedMm = 60;
constexpr double kUnexplainedShare = 0.01;
constexpr double kBetterMm = 0.5;
// So many stances of a limb, which end this far apart, are looked at closely.
constexpr std::size_t kRefined = 8;
constexpr std::size_t kPairRefined = 14;
constexpr double kApartMm = 150;
constexpr std::size_t kPairsTried = 3;
constexpr std::size_t kExchangesTried = 4;
// After a search in vain.
constexpr double kRestS = 0.045;
constexpr int kIterations = 5;
constexpr std::array<Segment, 4> kLimbEnds = {Segment::kHandL, Segment::kHandR, Segment::kFootL,
                                              Segment::kFootR};
constexpr std::array<std::pair<Segment, Segment>, 2> kPairs = {
    std::pair{Segment::kHandL, Segment::kHandR}, std::pair{Segment::kFootL, Segment::kFootR}};

std::vector<Stance> ArmStances() {
  std::vector<Stance> stances;
  for (const double raise : {-85.0, -45.0, 0.0, 45.0, 85.0}) {
    for (const double forward : {-35.0, 15.0, 65.0, 115.0}) {
      for (const double elbow : {15.0, 60.0, 110.0}) {
        for (const double twist : {-50.0, 0.0, 50.0}) {
          if (elbow < 30 && twist != 0) continue;
          const ArmStance arm{raise, forward, twist, elbow};
          stances.push_back({.arm_l = arm, .arm_r = arm, .leg_l = {}, .leg_r = {}});
        }
      }
    }
  }
  return stances;
}

std::vector<Stance> LegStances() {
  std::vector<Stance> stances;
  for (const double hip : {-50.0, -15.0, 20.0, 60.0, 100.0}) {
    for (const double spread : {-10.0, 30.0, 70.0}) {
      for (const double knee : {10.0, 60.0, 110.0}) {
        const LegStance leg{hip, spread, knee};
        stances.push_back({.arm_l = {}, .arm_r = {}, .leg_l = leg, .leg_r = leg});
      }
    }
  }
  return stances;
}

double UnexplainedShare(ContactMatcher& matcher, const std::vector<PosedCapsule>& posed) {
  const std::vector<float>& distances_mm = matcher.Distances(posed, kReachMm);
  int edges = 0;
  int unexplained = 0;
  for (std::size_t i = 0; i < distances_mm.size(); ++i) {
    if (!matcher.contacts()[i].is_edge) continue;
    ++edges;
    unexplained += distances_mm[i] > kUnexplainedMm;
  }
  return edges == 0 ? 0 : static_cast<double>(unexplained) / edges;
}

struct Candidate {
  PoseState pose;
  double cost_mm;
};

// A stance of a limb that is one of a pair.
struct Option {
  PoseState pose;
  LimbClaim claim;
};

// Of those that put the limb's end in the same place only the first.
std::vector<Candidate> KeepDistinct(LimbSearch& search, const std::vector<Candidate>& candidates,
                                    std::size_t count) {
  std::vector<Candidate> kept;
  std::vector<Vector3> tips_W;
  for (const Candidate& candidate : candidates) {
    const Vector3 tip_W = search.TipAt(candidate.pose);
    const bool is_known = std::ranges::any_of(
        tips_W, [&](const Vector3& other_W) { return (other_W - tip_W).norm() < kApartMm; });
    if (is_known) continue;
    tips_W.push_back(tip_W);
    kept.push_back(candidate);
    if (kept.size() == count) break;
  }
  return kept;
}

// The limb in each of the stances, the cheapest first.
template <typename Cost>
std::vector<Candidate> Ranked(const LimbSearch& search, const BodyTable& table,
                              const std::vector<Stance>& stances, const PoseState& pose,
                              const Cost& cost_mm) {
  std::vector<Candidate> candidates;
  for (const Stance& stance : stances) {
    const JointAngles angles = AnglesOf(stance, table);
    Candidate candidate{pose, 0};
    for (const int row : search.rows()) candidate.pose.theta[row] = angles[row];
    candidate.cost_mm = cost_mm(candidate.pose);
    candidates.push_back(candidate);
  }
  std::ranges::sort(candidates, {}, &Candidate::cost_mm);
  return candidates;
}

void Refine(LimbSearch& search, std::vector<Candidate>& candidates) {
  for (Candidate& candidate : candidates) {
    search.Refine(candidate.pose, kIterations);
    candidate.cost_mm = search.CostAt(candidate.pose);
  }
  std::ranges::sort(candidates, {}, &Candidate::cost_mm);
}

// The best of the stances that put the limb's end in different places, refined, the best first.
std::vector<Candidate> BestOf(LimbSearch& search, const BodyTable& table,
                              const std::vector<Stance>& stances, const PoseState& pose,
                              std::size_t count) {
  const auto cost_mm = [&](const PoseState& at) { return search.CostAt(at); };
  std::vector<Candidate> best =
      KeepDistinct(search, Ranked(search, table, stances, pose, cost_mm), count);
  Refine(search, best);
  return best;
}

// The stances that put the limb's end nearest to a place, refined, the best first.
std::vector<Candidate> Towards(LimbSearch& search, const BodyTable& table,
                               const std::vector<Stance>& stances, const PoseState& pose,
                               const Vector3& p_WQ) {
  const auto cost_mm = [&](const PoseState& at) { return (search.TipAt(at) - p_WQ).norm(); };
  std::vector<Candidate> nearest = Ranked(search, table, stances, pose, cost_mm);
  nearest.resize(std::min(nearest.size(), kExchangesTried));
  Refine(search, nearest);
  return nearest;
}

}  // namespace

LimbRecovery::LimbRecovery() : arm_stances_(ArmStances()), leg_stances_(LegStances()) {}

const std::vector<Stance>& LimbRecovery::StancesOf(Segment limb_end) const {
  const bool is_arm = limb_end == Segment::kHandL || limb_end == Segment::kHandR;
  return is_arm ? arm_stances_ : leg_stances_;
}

bool LimbRecovery::IsExplained(const BodyModel& body, const PoseState& pose) {
  body.PoseShape(body.PostureAt(pose), posed_);
  return UnexplainedShare(matcher_, posed_) < kUnexplainedShare;
}

bool LimbRecovery::RecoverOne(const BodyModel& body, const Evidence& evidence, Segment limb_end,
                              PoseState& pose) {
  LimbSearch search(body, evidence, matcher_, limb_end, limb_end, pose);
  const Candidate best = BestOf(search, body.table(), StancesOf(limb_end), pose, kRefined).front();
  if (best.cost_mm > search.CostAt(pose) - kBetterMm) return false;
  pose = best.pose;
  return true;
}

bool LimbRecovery::HandsMeet(const BodyModel& body, const PoseState& pose) {
  const BodyPoints points_W = body.PointsAt(body.PostureAt(pose));
  const Vector3 apart_W = points_W.col(static_cast<int>(Point::kFingertipsL)) -
                          points_W.col(static_cast<int>(Point::kFingertipsR));
  return apart_W.norm() < body.sizes().lower_arm;
}

template <typename Stances>
bool LimbRecovery::RecoverPair(const BodyModel& body, const Evidence& evidence, Segment left,
                               Segment right, SurfaceFit& fit, const Stances& stances,
                               PoseState& pose) {
  LimbSearch left_search(body, evidence, matcher_, left, right, pose);
  LimbSearch right_search(body, evidence, matcher_, right, left, pose);
  const auto options = [&](LimbSearch& search, LimbSearch& other) {
    std::vector<Option> found;
    for (const Candidate& candidate : stances(search, other)) {
      found.push_back({candidate.pose, search.ClaimAt(candidate.pose)});
    }
    return found;
  };
  const std::vector<Option> lefts = options(left_search, right_search);
  const std::vector<Option> rights = options(right_search, left_search);
  std::vector<Candidate> pairs;
  for (const Option& l : lefts) {
    for (const Option& r : rights) {
      Candidate pair{l.pose, left_search.JointCost(l.claim, r.claim)};
      for (const int row : right_search.rows()) pair.pose.theta[row] = r.pose.theta[row];
      pairs.push_back(pair);
    }
  }
  std::ranges::sort(pairs, {}, &Candidate::cost_mm);
  pairs.resize(std::min(pairs.size(), kPairsTried));
  for (Candidate& pair : pairs) pair.cost_mm = fit.QualityAt(body, pair.pose).Cost();
  const Candidate& best = *std::ranges::min_element(pairs, {}, &Candidate::cost_mm);
  if (best.cost_mm > fit.QualityAt(body, pose).Cost() - kBetterMm) return false;
  pose = best.pose;
  return true;
}

bool LimbRecovery::RecoverLost(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                               PoseState& pose) {
  if (rest_s_ > 0) return false;
  bool changed = false;
  for (const Segment limb_end : kLimbEnds) {
    changed |= RecoverOne(body, evidence, limb_end, pose);
  }
  if (IsExplained(body, pose)) return changed;
  for (const auto& [left, right] : kPairs) {
    const auto best = [&](LimbSearch& search, LimbSearch&) {
      return BestOf(search, body.table(), StancesOf(left), pose, kPairRefined);
    };
    changed |= RecoverPair(body, evidence, left, right, fit, best, pose);
  }
  if (!changed) rest_s_ = kRestS;
  return changed;
}

bool LimbRecovery::ExchangeArms(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                                PoseState& pose) {
  const auto exchanged = [&](LimbSearch& search, LimbSearch& other) {
    return Towards(search, body.table(), arm_stances_, pose, other.TipAt(pose));
  };
  return RecoverPair(body, evidence, Segment::kHandL, Segment::kHandR, fit, exchanged, pose);
}

std::optional<PoseState> LimbRecovery::Recover(const BodyModel& body, const Evidence& evidence,
                                               SurfaceFit& fit, const PoseState& pose,
                                               const SurfaceFitQuality& quality, double dt_s) {
  rest_s_ -= dt_s;
  const bool is_explained = quality.unexplained_share < kUnexplainedShare;
  const bool hands_meet = HandsMeet(body, pose);
  if (is_explained) {
    rest_s_ = 0;
    if (!hands_meet) return std::nullopt;
  }
  ChooseContacts(evidence, kVoxels, kEdges, contacts_);
  matcher_.SetContacts(contacts_);
  PoseState now = pose;
  bool changed = !is_explained && RecoverLost(body, evidence, fit, now);
  if (hands_meet) changed |= ExchangeArms(body, evidence, fit, now);
  if (!changed) return std::nullopt;
  return now;
}

}  // namespace mocap
