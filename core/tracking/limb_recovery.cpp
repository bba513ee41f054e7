#include "core/tracking/limb_recovery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/body/stance.h"
#include "core/tracking/rival_pose.h"

namespace mocap {
namespace {

constexpr int kVoxels = 150;
constexpr int kEdges = 600;
constexpr double kReachMm = 150;
constexpr double kUnexplainedShare = 0.005;
constexpr double kBetterMm = 0.5;
// Number of a limb's stances to refine, with ends at least this far apart.
constexpr std::size_t kRefined = 8;
constexpr std::size_t kPairRefined = 14;
constexpr double kApartMm = 150;
constexpr std::size_t kPairsTried = 3;
constexpr std::size_t kExchangesTried = 4;
// A moved limb is compared after the whole body was fitted to the evidence with it, as was done
// with the present one. Before that, a correct position costs up to this much more, a wrong one
// less. Several positions are tried.
constexpr double kElsewhereMm = 100;
constexpr double kWorthDrawingMm = 4;
constexpr std::size_t kDrawn = 4;
// Likewise for both arms or both legs, which move the trunk more. If frames follow soon, the best
// pair will do: the next frame is another chance.
constexpr double kPairWorthDrawingMm = 7;
constexpr double kPairsDrawnPerS = 30;
// In a body's first frame, a pose that costs this much less is taken: the gain must be clear. For
// exchanged limbs it is larger, because noise exchanges folded arms.
constexpr double kLimbBetterMm = 0.6;
constexpr double kExchangeBetterMm = 1.5;
// In later frames, a pose that costs this much less is taken at once; where frames are rare, one
// with a smaller gain too, see ClearLeadMm. Otherwise, and if it costs at most kRivalMm more, the
// next frames decide.
constexpr double kSureMm = 3;
constexpr double kRivalMm = 2;
// After a failed search at the least share that triggers one; shorter if more is unexplained.
constexpr double kLongestRestS = 0.8;
// At high frame rates, a search is spread over several frames, so that no frame is late. Each limb
// is searched alone, then each pair, which costs as much as two limbs.
constexpr double kLimbsPerS = 80;
constexpr double kWholeSearch = 8;
constexpr int kIterations = 5;
constexpr std::array<Segment, 4> kLimbEnds = {Segment::kHandL, Segment::kHandR, Segment::kFootL,
                                              Segment::kFootR};
constexpr std::array<std::pair<Segment, Segment>, 2> kPairs = {
    std::pair{Segment::kHandL, Segment::kHandR}, std::pair{Segment::kFootL, Segment::kFootR}};

std::vector<JointAngles> ArmStances(const BodyTable& table) {
  std::vector<JointAngles> stances;
  for (const double raise : {-85.0, -45.0, 0.0, 45.0, 85.0}) {
    for (const double forward : {-35.0, 15.0, 65.0, 115.0}) {
      for (const double elbow : {15.0, 60.0, 110.0}) {
        for (const double twist : {-50.0, 0.0, 50.0}) {
          if (elbow < 30 && twist != 0) continue;
          const ArmStance arm{raise, forward, twist, elbow};
          stances.push_back(
              AnglesOf({.arm_l = arm, .arm_r = arm, .leg_l = {}, .leg_r = {}}, table));
        }
      }
    }
  }
  return stances;
}

std::vector<JointAngles> LegStances(const BodyTable& table) {
  std::vector<JointAngles> stances;
  for (const double hip : {-50.0, -15.0, 20.0, 60.0, 100.0}) {
    for (const double spread : {-10.0, 30.0, 70.0}) {
      for (const double knee : {10.0, 60.0, 110.0}) {
        const LegStance leg{hip, spread, knee};
        stances.push_back(AnglesOf({.arm_l = {}, .arm_r = {}, .leg_l = leg, .leg_r = leg}, table));
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
    unexplained += distances_mm[i] >= kExplainedMm;
  }
  return edges == 0 ? 0 : static_cast<double>(unexplained) / edges;
}

}  // namespace

LimbRecovery::LimbRecovery(const BodyTable& table)
    : arm_stances_(ArmStances(table)), leg_stances_(LegStances(table)) {}

const std::vector<JointAngles>& LimbRecovery::StancesOf(Segment limb_end) const {
  const bool is_arm = limb_end == Segment::kHandL || limb_end == Segment::kHandR;
  return is_arm ? arm_stances_ : leg_stances_;
}

bool LimbRecovery::IsExplained(const BodyModel& body, const PoseState& pose) {
  body.PoseShape(body.PostureAt(pose), posed_);
  return UnexplainedShare(matcher_, posed_) < kUnexplainedShare;
}

template <typename Cost>
void LimbRecovery::Rank(const LimbSearch& search, const std::vector<JointAngles>& stances,
                        const PoseState& pose, const Cost& cost_mm) {
  candidates_.clear();
  for (const JointAngles& angles : stances) {
    Candidate candidate{pose, 0};
    for (const int row : search.rows()) candidate.pose.theta[row] = angles[row];
    candidate.cost_mm = cost_mm(candidate.pose);
    candidates_.push_back(candidate);
  }
  std::ranges::sort(candidates_, {}, &Candidate::cost_mm);
}

void LimbRecovery::KeepDistinct(LimbSearch& search, std::size_t count) {
  tips_W_.clear();
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    if (tips_W_.size() == count) return true;
    const Vector3 tip_W = search.TipAt(candidate.pose);
    const bool is_known = std::ranges::any_of(
        tips_W_, [&](const Vector3& other_W) { return (other_W - tip_W).norm() < kApartMm; });
    if (!is_known) tips_W_.push_back(tip_W);
    return is_known;
  });
}

void LimbRecovery::Refine(LimbSearch& search) {
  for (Candidate& candidate : candidates_) {
    search.Refine(candidate.pose, kIterations);
    candidate.cost_mm = search.CostAt(candidate.pose);
  }
  std::ranges::sort(candidates_, {}, &Candidate::cost_mm);
}

void LimbRecovery::FindBest(LimbSearch& search, const std::vector<JointAngles>& stances,
                            const PoseState& pose, std::size_t count) {
  Rank(search, stances, pose, [&](const PoseState& at) { return search.CostAt(at); });
  KeepDistinct(search, count);
  Refine(search);
}

void LimbRecovery::FindTowards(LimbSearch& search, const std::vector<JointAngles>& stances,
                               const PoseState& pose, const Vector3& p_WQ) {
  Rank(search, stances, pose,
       [&](const PoseState& at) { return (search.TipAt(at) - p_WQ).norm(); });
  candidates_.resize(std::min(candidates_.size(), kExchangesTried));
  Refine(search);
}

std::span<const LimbRecovery::Option> LimbRecovery::Claims(LimbSearch& search,
                                                           std::vector<Option>& memory) {
  if (memory.size() < candidates_.size()) memory.resize(candidates_.size());
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    memory[i].pose = candidates_[i].pose;
    memory[i].claim = search.ClaimAt(candidates_[i].pose);
  }
  return {memory.data(), candidates_.size()};
}

bool LimbRecovery::RecoverOne(const BodyModel& body, const Evidence& evidence, Segment limb_end,
                              SurfaceFit& fit, Candidate& present) {
  const PoseState& pose = present.pose;
  search_.Begin(body, evidence, matcher_, limb_end, limb_end, pose, fit.allowed());
  FindBest(search_, StancesOf(limb_end), pose, kRefined);
  const double now_mm = search_.CostAt(pose);
  const Vector3 tip_W = search_.TipAt(pose);
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    const bool is_elsewhere = (search_.TipAt(candidate.pose) - tip_W).norm() > kElsewhereMm;
    return candidate.cost_mm > now_mm + (is_elsewhere ? kWorthDrawingMm : -kBetterMm);
  });
  if (candidates_.empty()) return false;
  candidates_.resize(std::min(candidates_.size(), kDrawn));
  for (Candidate& candidate : candidates_) DrawNear(body, fit, candidate);
  const Candidate& best = *std::ranges::min_element(candidates_, {}, &Candidate::cost_mm);
  return Offer(best, GainToTake(kLimbBetterMm), present);
}

bool LimbRecovery::Offer(const Candidate& offered, double gain_mm, Candidate& present) {
  if (offered.cost_mm <= present.cost_mm - gain_mm) {
    present = offered;
    return true;
  }
  const bool is_rival = offered.cost_mm <= present.cost_mm + kRivalMm &&
                        (!rival_ || offered.cost_mm < rival_->cost_mm);
  if (is_rival) rival_ = offered;
  return false;
}

bool LimbRecovery::IsWorthSearching(double unexplained_share) const {
  if (unexplained_share < kUnexplainedShare) return false;
  return next_ > 0 || rest_s_ <= 0 || unexplained_share >= vain_share_ + kUnexplainedShare;
}

bool LimbRecovery::HandsMeetAnew(const BodyModel& body, const PoseState& pose) {
  const BodyPoints points_W = body.PointsAt(body.PostureAt(pose));
  const Vector3 apart_W = points_W.col(static_cast<int>(Point::kFingertipsL)) -
                          points_W.col(static_cast<int>(Point::kFingertipsR));
  if (apart_W.norm() > body.sizes().lower_arm) {
    hands_met_T_.reset();
    return false;
  }
  const Vector3 apart_T = pose.X_WT.R.transpose() * apart_W;
  if (hands_met_T_ && (apart_T - *hands_met_T_).norm() < kElsewhereMm) return false;
  hands_met_T_ = apart_T;
  return true;
}

template <typename Stances>
bool LimbRecovery::OfferPair(const BodyModel& body, const Evidence& evidence,
                             const std::pair<Segment, Segment>& limb_ends, SurfaceFit& fit,
                             const Stances& stances, double gain_mm, Candidate& present) {
  const auto [left, right] = limb_ends;
  const PoseState& pose = present.pose;
  search_.Begin(body, evidence, matcher_, left, right, pose, fit.allowed());
  other_search_.Begin(body, evidence, matcher_, right, left, pose, fit.allowed());
  stances(search_, other_search_);
  const std::span<const Option> lefts = Claims(search_, lefts_);
  stances(other_search_, search_);
  const std::span<const Option> rights = Claims(other_search_, rights_);
  pairs_.clear();
  for (const Option& l : lefts) {
    for (const Option& r : rights) {
      Candidate pair{l.pose, search_.JointCost(l.claim, r.claim)};
      for (const int row : other_search_.rows()) pair.pose.theta[row] = r.pose.theta[row];
      pairs_.push_back(pair);
    }
  }
  std::ranges::sort(pairs_, {}, &Candidate::cost_mm);
  pairs_.resize(std::min(pairs_.size(), kPairsTried));
  for (Candidate& pair : pairs_) pair.cost_mm = fit.QualityAt(body, pair.pose).Cost();
  std::ranges::sort(pairs_, {}, &Candidate::cost_mm);
  pairs_.resize(std::min(pairs_.size(), pairs_drawn_));
  std::erase_if(pairs_, [&](const Candidate& pair) {
    return pair.cost_mm > present.cost_mm + kPairWorthDrawingMm;
  });
  if (pairs_.empty()) return false;
  for (Candidate& pair : pairs_) DrawNear(body, fit, pair);
  return Offer(*std::ranges::min_element(pairs_, {}, &Candidate::cost_mm), gain_mm, present);
}

void LimbRecovery::DrawNear(const BodyModel& body, SurfaceFit& fit, Candidate& candidate) {
  PoseFilter filter{MotionNoise{}};
  filter.Jump(candidate.pose);
  filter.Draw(
      body.table(),
      [&](const PoseState& pose, UpdateEquations& equations) {
        fit.Linearize(body, pose, equations);
      },
      Iterations{});
  candidate = {filter.pose(), fit.QualityAt(body, filter.pose()).Cost()};
}

bool LimbRecovery::RecoverLost(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                               Candidate& present) {
  bool changed = false;
  for (; next_ < kLimbEnds.size() + kPairs.size() && allowance_ > 0; ++next_) {
    if (next_ < kLimbEnds.size()) {
      changed |= RecoverOne(body, evidence, kLimbEnds[next_], fit, present);
      allowance_ -= 1;
      continue;
    }
    if (next_ == kLimbEnds.size() && IsExplained(body, present.pose)) {
      StartOver();
      return changed;
    }
    changed |= RecoverPair(body, evidence, kPairs[next_ - kLimbEnds.size()], fit, present);
    allowance_ -= 2;
  }
  is_in_vain_ &= !changed;
  if (next_ < kLimbEnds.size() + kPairs.size()) return changed;
  if (is_in_vain_) {
    vain_share_ = begun_share_;
    rest_s_ = kLongestRestS * kUnexplainedShare / begun_share_;
  }
  StartOver();
  return changed;
}

void LimbRecovery::StartOver() {
  next_ = 0;
  is_in_vain_ = true;
}

bool LimbRecovery::RecoverPair(const BodyModel& body, const Evidence& evidence,
                               const std::pair<Segment, Segment>& limb_ends, SurfaceFit& fit,
                               Candidate& present) {
  const auto best = [&](LimbSearch& search, LimbSearch&) {
    FindBest(search, StancesOf(limb_ends.first), present.pose, kPairRefined);
  };
  return OfferPair(body, evidence, limb_ends, fit, best, GainToTake(kBetterMm), present);
}

bool LimbRecovery::Exchange(const BodyModel& body, const Evidence& evidence,
                            const std::pair<Segment, Segment>& limb_ends, SurfaceFit& fit,
                            Candidate& present) {
  const auto exchanged = [&](LimbSearch& search, LimbSearch& other) {
    FindTowards(search, StancesOf(limb_ends.first), present.pose, other.TipAt(present.pose));
  };
  return OfferPair(body, evidence, limb_ends, fit, exchanged, GainToTake(kExchangeBetterMm),
                   present);
}

std::optional<PoseState> LimbRecovery::Recover(const BodyModel& body, const Evidence& evidence,
                                               SurfaceFit& fit, const PoseState& pose,
                                               const SurfaceFitQuality& quality, double dt_s) {
  rest_s_ -= dt_s;
  rival_.reset();
  sure_mm_ = std::min(kSureMm, ClearLeadMm(dt_s));
  pairs_drawn_ = std::max<std::size_t>(1, std::lround(kPairsDrawnPerS * dt_s));
  allowance_ = is_first_ ? kWholeSearch : std::min(allowance_, 0.0) + kLimbsPerS * dt_s;
  const double share = quality.unexplained_share;
  if (share < kUnexplainedShare) StartOver();
  const bool searches = allowance_ > 0 && IsWorthSearching(share);
  if (searches && next_ == 0) begun_share_ = share;
  const bool exchanges = HandsMeetAnew(body, pose);
  if (!searches && !exchanges && !is_first_) return std::nullopt;
  ChooseContacts(evidence, kVoxels, kEdges, contacts_);
  matcher_.SetContacts(contacts_);
  Candidate present{pose, 0};
  DrawNear(body, fit, present);
  bool changed = searches && RecoverLost(body, evidence, fit, present);
  if (exchanges) changed |= Exchange(body, evidence, kPairs[0], fit, present);
  if (is_first_ || (changed && pairs_drawn_ > 1))
    changed |= Exchange(body, evidence, kPairs[1], fit, present);
  if (is_first_) changed |= RecoverPair(body, evidence, kPairs[0], fit, present);
  is_first_ = false;
  if (!changed) return std::nullopt;
  return present.pose;
}

}  // namespace mocap
