#include "core/proposals/limb_proposals.h"

#include <algorithm>

#include "core/body/stance.h"

namespace mocap {
namespace {

// How many stances of a limb are looked at, one step after the other.
struct LimbEffort {
  std::size_t in_flesh = 40;                    // Those whose bones lie in flesh best are compared,
  std::size_t refined = 8, second_refined = 4;  // the best of them refined,
  std::size_t proposed = 2, firsts = 2;  // and these left: of a single limb; of a pair's first.
  double apart_mm = 150;                 // At least, between the limb's ends.
};
constexpr LimbEffort kEffort{};

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

}  // namespace

LimbProposals::LimbProposals(const BodyTable& table)
    : arm_stances_(ArmStances(table)), leg_stances_(LegStances(table)) {}

const std::vector<JointAngles>& LimbProposals::StancesOf(Segment limb_end) const {
  const bool is_arm = limb_end == Segment::kHandL || limb_end == Segment::kHandR;
  return is_arm ? arm_stances_ : leg_stances_;
}

template <typename Cost>
void LimbProposals::Rank(const std::vector<JointAngles>& stances, const PoseState& pose,
                         const Cost& cost) {
  candidates_.clear();
  for (const JointAngles& angles : stances) {
    Candidate candidate{pose, 0};
    for (const int row : limb_.rows()) candidate.pose.theta[row] = angles[row];
    candidate.nats = cost(candidate.pose);
    candidates_.push_back(candidate);
  }
  std::ranges::sort(candidates_, {}, &Candidate::nats);
}

void LimbProposals::KeepDistinct(std::size_t count) {
  tips_W_.clear();
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    if (tips_W_.size() == count) return true;
    const Vector3 tip_W = limb_.TipAt(candidate.pose);
    const bool is_known = std::ranges::any_of(tips_W_, [&](const Vector3& other_W) {
      return (other_W - tip_W).norm() < kEffort.apart_mm;
    });
    if (!is_known) tips_W_.push_back(tip_W);
    return is_known;
  });
}

void LimbProposals::Refine() {
  for (Candidate& candidate : candidates_) {
    limb_.Refine(candidate.pose);
    candidate.nats = limb_.At(candidate.pose);
  }
  std::ranges::sort(candidates_, {}, &Candidate::nats);
}

void LimbProposals::FindBest(Segment limb_end, const PoseState& pose, std::size_t refined,
                             std::size_t count) {
  Rank(StancesOf(limb_end), pose, [&](const PoseState& at) { return limb_.FleshAt(at); });
  candidates_.resize(std::min(candidates_.size(), kEffort.in_flesh));
  for (Candidate& candidate : candidates_) candidate.nats = limb_.At(candidate.pose);
  std::ranges::sort(candidates_, {}, &Candidate::nats);
  KeepDistinct(refined);
  Refine();
  KeepDistinct(count);
}

void LimbProposals::Elsewhere(Objective& objective, const Hypothesis& present, Segment limb_end,
                              std::vector<PoseState>& poses) {
  const PoseState& pose = present.filter.pose();
  limb_.Begin(objective, present.body, pose, limb_end, limb_end, present.things);
  const Vector3 tip_W = limb_.TipAt(pose);
  FindBest(limb_end, pose, kEffort.refined, kEffort.proposed + 1);
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    return (limb_.TipAt(candidate.pose) - tip_W).norm() < kEffort.apart_mm / 2;
  });
  candidates_.resize(std::min(candidates_.size(), kEffort.proposed));
  for (const Candidate& candidate : candidates_) poses.push_back(candidate.pose);
}

void LimbProposals::Both(Objective& objective, const Hypothesis& present, const LimbPair& limb_ends,
                         std::vector<PoseState>& poses) {
  const auto [first, second] = limb_ends;
  limb_.Begin(objective, present.body, present.filter.pose(), first, second, present.things);
  FindBest(first, present.filter.pose(), kEffort.refined, kEffort.firsts);
  std::swap(firsts_, candidates_);
  for (const Candidate& candidate : firsts_) {
    limb_.Begin(objective, present.body, candidate.pose, second, second, present.things);
    FindBest(second, candidate.pose, kEffort.second_refined, 1);
    poses.push_back(candidates_.front().pose);
  }
}

}  // namespace mocap
