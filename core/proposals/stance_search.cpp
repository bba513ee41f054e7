#include "core/proposals/stance_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mocap {
namespace {

// Bodies of strangers. Clothes and hulls make everybody appear stouter. With realistic widths,
// people would be taken for taller ones.
struct Statures {
  double smallest_mm = 1080, largest_mm = 2080;
  double step = 1.06;  // Ratio of two that follow each other.
  int coarse = 3;      // Every third is tried first; then its neighbours.
};
constexpr Statures kStatures{};
// Factors of an average person's widths. The second is tried first.
constexpr std::array<double, 4> kBuilds = {1, 1.15, 1.32, 1.52};
constexpr int kCoarseBuild = 1;
// After the other builds comes this one in a skirt. It is only tried as a neighbour: in a skirt,
// who faces backwards looks nearly the same.
constexpr int kDrapedBuild = static_cast<int>(kBuilds.size());

struct SearchLimits {
  double pose_std_mm = 100, pose_std_rad = 0.5;  // Uncertainty of a proposed pose.
  // Share of the edges that miss the hull. Beyond it, flesh is torn, and what no part explains is
  // no evidence of a thing.
  double missing_share = 0.05;
  double same_mm = 60;  // Mean distance of the points of poses that are equal.
  std::size_t kept = 6, with_neighbours = 3;
  int neighbourhoods = 2;
  double middle_share = 0.55;  // Height of a standing person's middle, as a share of the stature.
};
constexpr SearchLimits kSearch{};

BodySizes SizesOf(double stature_mm, double build) {
  BodySizes sizes = AverageSizes(stature_mm);
  for (const SizeMember width : kStoutWidths) sizes.*width *= build;
  return sizes;
}

BodySizes InSkirt(BodySizes sizes, double stature_mm) {
  sizes.drape_hip = 0.02 * stature_mm;
  sizes.drape_knee = 0.045 * stature_mm;
  sizes.drape_calf = 0.03 * stature_mm;
  return sizes;
}

// Possible positions of a person's middle: that of the flesh; and if legs were carved away, that of
// a person standing on the floor below.
std::vector<Vector3> MiddlesOf(const VoxelCloud& cloud) {
  std::vector<Vector3> middles_W = {cloud.Centroid()};
  const auto height_mm = [](const Voxel& voxel) { return voxel.center_W.z(); };
  const auto [lowest, highest] = std::ranges::minmax(cloud.voxels(), {}, height_mm);
  if (!LacksLegs(height_mm(lowest))) return middles_W;
  const Vector3 middle_W = middles_W.front();
  middles_W.emplace_back(middle_W.x(), middle_W.y(), kSearch.middle_share * height_mm(highest));
  return middles_W;
}

}  // namespace

// Number of samples, iterations of the fit, and number of poses that remain.
struct StanceSearch::Round {
  int voxels, rays;
  double pose_std_mm;     ///< How far the poses are off.
  Iterations iterations;  ///< With 0, poses are compared as they are.
  double kept;            ///< In a search with full effort.
};

StanceSearch StanceSearch::OfStrangers(const BodyTable& table) {
  std::vector<BodyModel> bodies;
  for (double stature_mm = kStatures.smallest_mm; stature_mm < kStatures.largest_mm;
       stature_mm *= kStatures.step) {
    for (const double build : kBuilds) bodies.emplace_back(table, SizesOf(stature_mm, build));
    bodies.emplace_back(table, InSkirt(SizesOf(stature_mm, kBuilds[kCoarseBuild]), stature_mm));
  }
  return {std::move(bodies), kDrapedBuild + 1};
}

StanceSearch::StanceSearch(std::vector<BodyModel> bodies, int builds)
    : bodies_(std::move(bodies)), builds_(builds) {
  for (const BodyModel& body : bodies_) libraries_.emplace_back(body);
}

const std::vector<StanceCandidate>& StanceSearch::Find(Objective& frame, const SearchScope& scope) {
  // Most poses are far off, and few samples show that. The first round only weighs them.
  constexpr std::array kRounds = {Round{40, 80, kSearch.pose_std_mm, {0, 0}, 160},
                                  Round{40, 80, kSearch.pose_std_mm / 2, {2, 4}, 48},
                                  Round{80, 120, kSearch.pose_std_mm / 4, {3, 6}, 12}};
  constexpr Round kFinal{150, 200, 0, {4, 15}, 20};
  const std::vector<StanceCandidate> best_before = std::exchange(candidates_, {});
  Propose(frame.evidence().cloud);
  for (const Round& round : kRounds) Play(round, scope, frame);
  candidates_.insert(candidates_.end(), best_before.begin(), best_before.end());
  Play(kFinal, {1, scope.things}, frame);
  KeepDistinct();
  for (int i = 0; i < kSearch.neighbourhoods && bodies_.size() > 1; ++i) {
    ProposeNeighbours();
    Play(kFinal, {1, scope.things}, frame);
    KeepDistinct();
  }
  return candidates_;
}

void StanceSearch::Remember(const BodySizes& sizes, const PoseState& pose) {
  const auto nearest = std::ranges::min_element(bodies_, {}, [&](const BodyModel& body) {
    return std::abs(body.sizes().Stature() - sizes.Stature()) +
           std::abs(body.sizes().torso_depth - sizes.torso_depth) +
           std::abs(body.sizes().drape_knee - sizes.drape_knee);
  });
  candidates_.push_back({static_cast<int>(nearest - bodies_.begin()), pose, 0});
}

void StanceSearch::Propose(const VoxelCloud& cloud) {
  const std::vector<Vector3> middles_W = MiddlesOf(cloud);
  const std::vector<Vector3> axes_W = TrunkAxes(cloud);
  const int first = builds_ == 1 ? 0 : (kStatures.coarse / 2) * builds_ + kCoarseBuild;
  for (int body = first; body < std::ssize(bodies_); body += kStatures.coarse * builds_) {
    poses_.clear();
    for (const Vector3& middle_W : middles_W)
      for (const Vector3& up_W : axes_W) libraries_[body].Propose(middle_W, up_W, poses_);
    for (const PoseState& pose : poses_) candidates_.push_back({body, pose, 0});
  }
}

// Bodies of the next size may explain the evidence better in the same pose.
void StanceSearch::ProposeNeighbours() {
  const std::size_t count = std::min(candidates_.size(), kSearch.with_neighbours);
  for (std::size_t i = 0; i < count; ++i) {
    const int body = candidates_[i].body, build = body % builds_;
    const auto propose = [&](int other) {
      if (other >= 0 && other < std::ssize(bodies_))
        candidates_.push_back({other, candidates_[i].pose, 0});
    };
    propose(body - builds_);
    propose(body + builds_);
    if (build == kDrapedBuild) {
      propose(body - kDrapedBuild + kCoarseBuild);
      continue;
    }
    if (build > 0) propose(body - 1);
    if (build + 1 < kDrapedBuild) propose(body + 1);
    propose(body - build + kDrapedBuild);
  }
}

void StanceSearch::Play(const Round& round, const SearchScope& scope, Objective& frame) {
  const Evidence& evidence = frame.evidence();
  Objective objective({round.voxels, round.rays, round.pose_std_mm});
  objective.SetEvidence(evidence);
  const Things things = evidence.MissingShare() < kSearch.missing_share ? scope.things : Things{};
  for (StanceCandidate& candidate : candidates_) {
    const BodyModel& body = bodies_[candidate.body];
    if (round.iterations.most > 0) {
      PoseFilter filter{MotionNoise{}};
      filter.Reset(candidate.pose, kSearch.pose_std_mm, kSearch.pose_std_rad);
      DrawNear(objective, body, {}, round.iterations, filter);
      candidate.pose = filter.pose();
    }
    const Fitness fitness = objective.At(body, candidate.pose, things);
    candidate.nats = fitness.Sum();
    candidate.things = fitness.things;
  }
  frame.CountAll(objective);
  std::ranges::stable_sort(candidates_, {}, &StanceCandidate::nats);
  const auto kept = static_cast<std::size_t>(std::ceil(scope.effort * round.kept));
  candidates_.resize(std::min(candidates_.size(), kept));
}

void StanceSearch::KeepDistinct() {
  std::vector<BodyPoints> kept_W;
  std::erase_if(candidates_, [&](const StanceCandidate& candidate) {
    if (kept_W.size() == kSearch.kept) return true;
    const BodyModel& body = bodies_[candidate.body];
    const BodyPoints points_W = body.PointsAt(body.PostureAt(candidate.pose));
    const bool is_known = std::ranges::any_of(kept_W, [&](const BodyPoints& other_W) {
      return (points_W - other_W).colwise().norm().mean() < kSearch.same_mm;
    });
    if (!is_known) kept_W.push_back(points_W);
    return is_known;
  });
}

}  // namespace mocap
