#include "core/acquisition/first_fit.h"

#include <algorithm>
#include <array>

#include "core/acquisition/pose_hypotheses.h"
#include "core/acquisition/size_fit.h"

namespace mocap {
namespace {

// So many guesses are followed closely, limbs and all.
constexpr std::size_t kFinalists = 3;

struct Candidate {
  PoseState pose;
  double cost_mm;
};

// How closely guesses are drawn to the voxels, and how many of them go on.
struct Round {
  SurfaceFitOptions options;
  Iterations iterations;
  std::size_t kept;
};

SurfaceFitOptions Samples(int voxels, int edges) {
  SurfaceFitOptions options;
  options.voxels = voxels;
  options.edges = edges;
  return options;
}

void Improve(const BodyModel& body, SurfaceFit& fit, const Iterations& iterations,
             Candidate& candidate) {
  PoseFilter filter{MotionNoise{}};
  filter.Reset(candidate.pose, 100, 0.5);
  filter.Update(
      body.table(),
      [&](const PoseState& pose, UpdateEquations& equations) {
        fit.Linearize(body, pose, equations);
      },
      iterations);
  candidate = {filter.pose(), fit.QualityAt(body, filter.pose()).Cost()};
}

// Nobody is acquired upside down.
bool IsUpright(const Candidate& candidate) { return candidate.pose.X_WT.R(2, 2) > 0; }

// Most guesses are far off, and a glance tells: the better they are, the closer they are looked at.
// The best comes first.
std::vector<Candidate> Compete(const BodyModel& body, const Evidence& evidence,
                               const std::vector<PoseState>& guesses) {
  const std::array<Round, 2> rounds = {Round{Samples(40, 80), {1, 4}, 10},
                                       {Samples(150, 200), {4, 15}, 10}};
  std::vector<Candidate> candidates;
  for (const PoseState& guess : guesses) candidates.push_back({guess, 0});
  for (const Round& round : rounds) {
    SurfaceFit fit(round.options);
    fit.SetEvidence(evidence);
    for (Candidate& candidate : candidates) Improve(body, fit, round.iterations, candidate);
    std::erase_if(candidates, [](const Candidate& candidate) { return !IsUpright(candidate); });
    std::ranges::stable_sort(candidates, {}, &Candidate::cost_mm);
    candidates.resize(std::min(candidates.size(), round.kept));
  }
  return candidates;
}

Tracker FollowClosely(const BodyModel& body, const Evidence& evidence, const PoseState& pose,
                      TrunkSize trunk) {
  BodyModel own = body;
  Candidate near{pose, 0};
  if (trunk == TrunkSize::kMeasured) {
    SurfaceFit fit(SurfaceFitOptions{});
    fit.SetEvidence(evidence);
    Improve(body, fit, Iterations{}, near);
    own.Resize(MeasureTrunk(body, fit, near.pose));
  }
  Tracker tracker(own, near.pose);
  tracker.Update(evidence, 0);
  return tracker;
}

bool FaceApart(const PoseState& a, const PoseState& b) {
  return a.X_WT.R.col(0).dot(b.X_WT.R.col(0)) < -0.3;
}

}  // namespace

std::vector<Tracker> FitBody(const BodyModel& body, const Evidence& evidence,
                             const LocalizedBody& located, TrunkSize trunk) {
  const std::vector<Candidate> candidates = Compete(body, evidence, PoseHypotheses(body, located));
  std::vector<Tracker> found;
  for (std::size_t i = 0; i < std::min(kFinalists, candidates.size()); ++i) {
    found.push_back(FollowClosely(body, evidence, candidates[i].pose, trunk));
  }
  if (found.empty()) return found;
  const auto cost = [](const Tracker& tracker) { return tracker.quality().Cost(); };
  std::ranges::stable_sort(found, {}, cost);
  found.resize(1, found.front());
  const auto opposite = std::ranges::find_if(candidates, [&](const Candidate& candidate) {
    return FaceApart(candidate.pose, found.front().filter().pose());
  });
  if (opposite == candidates.end()) return found;
  found.push_back(FollowClosely(body, evidence, opposite->pose, trunk));
  std::ranges::stable_sort(found, {}, cost);
  return found;
}

}  // namespace mocap
