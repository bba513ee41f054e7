#include "core/evaluation/people_accuracy.h"

#include <algorithm>
#include <set>

#include "core/evaluation/assignment.h"

namespace mocap {
namespace {

enum JointColumn { kNeckColumn = 1, kHipLColumn = 8, kHipRColumn = 9 };
static_assert(kScoredPoints[kNeckColumn] == Point::kNeck &&
              kScoredPoints[kHipLColumn] == Point::kHipL &&
              kScoredPoints[kHipRColumn] == Point::kHipR);

Vector3 TrunkOf(const ScoredPoints& p) {
  return (p.col(kNeckColumn) + (p.col(kHipLColumn) + p.col(kHipRColumn)) / 2) / 2;
}

double TrunkDistance(const ScoredPoints& a, const ScoredPoints& b) {
  return (TrunkOf(a) - TrunkOf(b)).norm();
}

double MeanDistance(const ScoredPoints& a, const ScoredPoints& b) {
  return (a - b).colwise().norm().mean();
}

// Gain of an assignment over a take: sums closeness over the sets in which both are near.
double GainOf(const PresenceBySet& person, const PosesBySet& followed) {
  double gain = 0;
  for (const auto& [set, there] : person) {
    const auto pose = followed.find(set);
    if (pose == followed.end()) continue;
    gain += std::max(0.0, 1 - MeanDistance(there.points_W, pose->second) / kNearMm);
  }
  return gain;
}

// Assigns tracked people to true people, set by set.
class Followers {
 public:
  Followers(std::span<const PresenceBySet> truth, std::span<const PosesBySet> followed)
      : truth_(truth), followed_(followed), of_(truth.size()) {
    std::set<int> sets;
    for (const PresenceBySet& person : truth)
      for (const auto& [set, there] : person) sets.insert(set);
    for (const PosesBySet& person : followed)
      for (const auto& [set, pose] : person) sets.insert(set);
    for (const int set : sets) Divide(set);
  }

  /// Returns by set: who tracks a true person.
  const std::map<int, int>& Of(std::size_t person) const { return of_[person]; }
  int phantom_sets() const { return phantom_sets_; }
  int duplicate_sets() const { return duplicate_sets_; }

 private:
  void Divide(int set) {
    const auto people = static_cast<Eigen::Index>(truth_.size());
    const auto others = static_cast<Eigen::Index>(followed_.size());
    // As many pairs as possible, then the nearest.
    constexpr double kPair_mm = 10 * kNearMm;
    Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(people, others);
    for (Eigen::Index i = 0; i < people; ++i)
      for (Eigen::Index j = 0; j < others; ++j) {
        const auto there = truth_[i].find(set);
        const auto pose = followed_[j].find(set);
        if (there == truth_[i].end() || pose == followed_[j].end()) continue;
        const double mm = TrunkDistance(there->second.points_W, pose->second);
        if (mm <= kNearMm) gain(i, j) = kPair_mm - mm;
      }
    const std::vector<int> by = AssignForMost(gain);
    for (std::size_t i = 0; i < by.size(); ++i)
      if (by[i] >= 0) of_[i][set] = by[i];
    for (Eigen::Index j = 0; j < others; ++j) {
      if (!followed_[j].contains(set)) continue;
      const bool is_near = people > 0 && gain.col(j).maxCoeff() > 0;
      phantom_sets_ += !is_near;
      duplicate_sets_ += is_near && std::ranges::find(by, static_cast<int>(j)) == by.end();
    }
  }

  std::span<const PresenceBySet> truth_;
  std::span<const PosesBySet> followed_;
  std::vector<std::map<int, int>> of_;
  int phantom_sets_ = 0, duplicate_sets_ = 0;
};

// The sets that count: entirely in the room for a while.
std::vector<int> SettledSets(const PresenceBySet& person, int settle_sets) {
  std::vector<int> settled;
  int whole_since = 0, last = -2;
  for (const auto& [set, there] : person) {
    if (!there.whole) continue;
    if (set != last + 1) whole_since = set;
    last = set;
    if (set >= whole_since + settle_sets) settled.push_back(set);
  }
  return settled;
}

int CountSwitches(const std::map<int, int>& by_set) {
  int switches = 0, last = -1;
  for (const auto& [set, follower] : by_set) {
    switches += last >= 0 && follower != last;
    last = follower;
  }
  return switches;
}

// The poses of the sets in which the trunks are near.
std::vector<ScoredFrame> NearPoses(const PresenceBySet& person, const PosesBySet& followed,
                                   std::span<const int> sets, std::vector<ScoredFrame>& truth) {
  std::vector<ScoredFrame> poses;
  for (const int set : sets) {
    const auto pose = followed.find(set);
    if (pose == followed.end()) continue;
    const ScoredPoints& points_W = person.at(set).points_W;
    if (TrunkDistance(points_W, pose->second) > kNearMm) continue;
    truth.push_back({.timestamp_ns = set, .points_W = points_W});
    poses.push_back({.timestamp_ns = set, .points_W = pose->second});
  }
  return poses;
}

void MeasureCovered(const PresenceBySet& person, std::span<const int> settled,
                    std::span<const ScoredFrame> near, const std::map<int, int>& by_set,
                    PersonAccuracy& accuracy) {
  std::set<int> near_sets;
  for (const ScoredFrame& frame : near) near_sets.insert(static_cast<int>(frame.timestamp_ns));
  int own = 0, found = 0, lost = 0;
  for (const int set : settled) {
    if (!person.at(set).covered) continue;
    const bool is_found = by_set.contains(set);
    own += near_sets.contains(set);
    found += is_found;
    if (is_found && accuracy.sets_to_first < 0) accuracy.sets_to_first = accuracy.covered_sets;
    lost = is_found || accuracy.sets_to_first < 0 ? 0 : lost + 1;
    accuracy.longest_lost_sets = std::max(accuracy.longest_lost_sets, lost);
    ++accuracy.covered_sets;
  }
  if (accuracy.covered_sets == 0) return;
  if (accuracy.sets_to_first < 0) accuracy.longest_lost_sets = accuracy.covered_sets;
  accuracy.covered_share = static_cast<double>(own) / accuracy.covered_sets;
  accuracy.covered_found_share = static_cast<double>(found) / accuracy.covered_sets;
}

}  // namespace

PeopleAccuracy MeasurePeople(std::span<const PresenceBySet> truth,
                             std::span<const PosesBySet> followed, int settle_sets) {
  Eigen::MatrixXd gain(truth.size(), followed.size());
  for (Eigen::Index i = 0; i < gain.rows(); ++i)
    for (Eigen::Index j = 0; j < gain.cols(); ++j) gain(i, j) = GainOf(truth[i], followed[j]);
  const std::vector<int> own = AssignForMost(gain);
  const Followers followers(truth, followed);

  PeopleAccuracy all{.people = {},
                     .phantom_sets = followers.phantom_sets(),
                     .duplicate_sets = followers.duplicate_sets()};
  double weight = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    PersonAccuracy& accuracy = all.people.emplace_back(PersonAccuracy{.followed_by = own[i]});
    const std::vector<int> settled = SettledSets(truth[i], settle_sets);
    std::vector<ScoredFrame> true_poses, poses;
    if (own[i] >= 0) poses = NearPoses(truth[i], followed[own[i]], settled, true_poses);
    if (!poses.empty()) {
      const Accuracy measured = MeasureAccuracy(true_poses, poses);
      accuracy.distance_mm = measured.distance_mm;
      accuracy.mean_angle_rad = measured.mean_angle_rad;
      all.mpjpe_mm += measured.distance_mm.mean * static_cast<double>(poses.size());
      weight += static_cast<double>(poses.size());
    }
    accuracy.switches = CountSwitches(followers.Of(i));
    MeasureCovered(truth[i], settled, poses, followers.Of(i), accuracy);
  }
  if (weight > 0) all.mpjpe_mm /= weight;
  return all;
}

}  // namespace mocap
