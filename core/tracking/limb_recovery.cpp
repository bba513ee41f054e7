#include "core/tracking/limb_recovery.h"

#include <algorithm>
#include <array>
#include <cmath>

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
constexpr int kRefined = 10;
constexpr int kIterations = 5;
constexpr std::array<Segment, 4> kLimbEnds = {Segment::kLowerArmL, Segment::kLowerArmR,
                                              Segment::kCalfL, Segment::kCalfR};

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

double UnexplainedShare(const std::vector<Contact>& contacts,
                        const std::vector<PosedCapsule>& posed) {
  int edges = 0;
  int unexplained = 0;
  for (const Contact& contact : contacts) {
    if (!contact.is_edge) continue;
    ++edges;
    const ContactMatch match = MatchContact(contact, posed, kReachMm);
    unexplained += match.capsule < 0 || std::abs(match.distance.outside_mm) > kUnexplainedMm;
  }
  return edges == 0 ? 0 : static_cast<double>(unexplained) / edges;
}

struct Candidate {
  PoseState pose;
  double cost_mm;
};

bool IsCheaper(const Candidate& a, const Candidate& b) { return a.cost_mm < b.cost_mm; }

// The best of the stances, the most promising of them refined.
Candidate BestOf(LimbSearch& search, const BodyTable& table, const std::vector<Stance>& stances,
                 const PoseState& pose) {
  std::vector<Candidate> candidates;
  for (const Stance& stance : stances) {
    const JointAngles angles = AnglesOf(stance, table);
    Candidate candidate{pose, 0};
    for (const int row : search.rows()) candidate.pose.theta[row] = angles[row];
    candidate.cost_mm = search.CostAt(candidate.pose);
    candidates.push_back(candidate);
  }
  const auto end = candidates.begin() + std::min<std::ptrdiff_t>(kRefined, std::ssize(candidates));
  std::partial_sort(candidates.begin(), end, candidates.end(), IsCheaper);
  for (auto candidate = candidates.begin(); candidate != end; ++candidate) {
    search.Refine(candidate->pose, kIterations);
    candidate->cost_mm = search.CostAt(candidate->pose);
  }
  return *std::min_element(candidates.begin(), end, IsCheaper);
}

}  // namespace

LimbRecovery::LimbRecovery() : arm_stances_(ArmStances()), leg_stances_(LegStances()) {}

std::optional<PoseState> LimbRecovery::Recover(const BodyModel& body, const Evidence& evidence,
                                               const PoseState& pose) {
  ChooseContacts(evidence, kVoxels, kEdges, contacts_);
  body.PoseShape(body.PostureAt(pose), posed_);
  if (UnexplainedShare(contacts_, posed_) < kUnexplainedShare) return std::nullopt;

  std::optional<PoseState> recovered;
  PoseState now = pose;
  for (const Segment limb_end : kLimbEnds) {
    const bool is_arm = limb_end == Segment::kLowerArmL || limb_end == Segment::kLowerArmR;
    LimbSearch search(body, evidence, contacts_, limb_end, now);
    const Candidate best = BestOf(search, body.table(), is_arm ? arm_stances_ : leg_stances_, now);
    if (best.cost_mm > search.CostAt(now) - kBetterMm) continue;
    now = best.pose;
    recovered = now;
  }
  return recovered;
}

}  // namespace mocap
