#include "tools/report/foot_contacts.h"

#include <cmath>
#include <cstdlib>
#include <vector>

namespace mocap {
namespace {

bool IsContact(double probability) { return probability > kContactLimit; }

/// Whether the true contact is as it was found, in this frame or within the tolerance of it.
bool HoldsNearby(const TakeTruth& truth, int contact, std::size_t frame, bool found) {
  const std::int64_t time_ns = truth.frames[frame].timestamp_ns;
  const auto is_found = [&](std::size_t i) {
    return IsContact(truth.extremities[i].contacts[contact]) == found;
  };
  if (is_found(frame)) return true;
  // It changes halfway between two frames.
  const auto holds_towards = [&](std::ptrdiff_t step) {
    for (auto i = static_cast<std::ptrdiff_t>(frame) + step; i >= 0 && i < std::ssize(truth.frames);
         i += step) {
      const auto at = static_cast<std::size_t>(i), before = static_cast<std::size_t>(i - step);
      const double apart_s =
          1e-9 * std::abs((truth.frames[at].timestamp_ns + truth.frames[before].timestamp_ns) / 2 -
                          time_ns);
      if (apart_s > kContactTolerance_s) return false;
      if (is_found(at)) return true;
    }
    return false;
  };
  return holds_towards(-1) || holds_towards(1);
}

void Count(bool found, bool is_right, ContactScore& score) {
  if (found) ++(is_right ? score.hits : score.false_alarms);
  if (!found && !is_right) ++score.misses;
}

/// The paths along the floor of one point, from when it comes to stand to when it leaves.
class StancePaths {
 public:
  void Stand(const Vector3& p_W) {
    const Vector2 p = p_W.head<2>();
    if (!is_standing_) {
      is_standing_ = true;
      began_ = p;
      farthest_mm_ = 0;
    } else {
      steps_mm_.push_back((p - last_).norm());
      farthest_mm_ = std::max(farthest_mm_, (p - began_).norm());
    }
    last_ = p;
  }

  void Leave() {
    if (is_standing_) stances_mm_.push_back(farthest_mm_);
    is_standing_ = false;
  }

  Skating Summary() const {
    Skating skating{.stances = static_cast<int>(stances_mm_.size())};
    if (!steps_mm_.empty()) skating.frame_p95_mm = SummarizeDistances(steps_mm_).p95;
    if (stances_mm_.empty()) return skating;
    const DistanceSummary stances = SummarizeDistances(stances_mm_);
    skating.stance_mean_mm = stances.mean;
    skating.stance_p95_mm = stances.p95;
    return skating;
  }

 private:
  bool is_standing_ = false;
  Vector2 began_ = Vector2::Zero(), last_ = Vector2::Zero();
  double farthest_mm_ = 0;
  std::vector<double> steps_mm_, stances_mm_;
};

/// Follows a contact's point, in the result or in the truth, through the frames.
template <typename PointOf>
void Follow(const TakeTruth& truth, std::span<const FrameError> frames, int contact,
            PointOf point_of, StancePaths& paths) {
  int last_truth = -2;
  for (const FrameError& frame : frames) {
    if (frame.truth != last_truth + 1) paths.Leave();
    last_truth = frame.truth;
    const Vector3 p_W = point_of(frame);
    const bool stands =
        IsContact(truth.extremities[static_cast<std::size_t>(frame.truth)].contacts[contact]);
    if (stands && p_W.allFinite()) {
      paths.Stand(p_W);
    } else {
      paths.Leave();
    }
  }
  paths.Leave();
}

}  // namespace

double ContactScore::Precision() const {
  return hits + false_alarms == 0 ? 1 : static_cast<double>(hits) / (hits + false_alarms);
}
double ContactScore::Recall() const {
  return hits + misses == 0 ? 1 : static_cast<double>(hits) / (hits + misses);
}
double ContactScore::F1() const {
  return IsEmpty() ? 1 : 2.0 * hits / (2 * hits + false_alarms + misses);
}

void MeasureContacts(const Result& result, const TakeTruth& truth,
                     std::span<const FrameError> frames, ExtremityAccuracy& accuracy) {
  std::array<StancePaths, 2> paths, true_paths;
  for (int contact = 0; contact < kContactCount; ++contact) {
    const auto part = static_cast<std::size_t>(contact) / 2;
    const Point point = kContactPoints[contact];
    for (const FrameError& frame : frames) {
      const double probability =
          result.poses[static_cast<std::size_t>(frame.pose)].contacts[contact];
      const auto at = static_cast<std::size_t>(frame.truth);
      if (std::isnan(probability) || std::isnan(truth.extremities[at].contacts[contact])) continue;
      const bool found = IsContact(probability);
      Count(found, HoldsNearby(truth, contact, at, found), accuracy.contacts[part]);
    }
    Follow(
        truth, frames, contact,
        [&](const FrameError& frame) -> Vector3 {
          return FurtherOf(result.poses[static_cast<std::size_t>(frame.pose)].further_W, point);
        },
        paths[part]);
    Follow(
        truth, frames, contact,
        [&](const FrameError& frame) -> Vector3 {
          return FurtherOf(truth.extremities[static_cast<std::size_t>(frame.truth)].points_W,
                           point);
        },
        true_paths[part]);
  }
  for (const std::size_t part : {0, 1}) {
    accuracy.skating[part] = paths[part].Summary();
    accuracy.true_skating[part] = true_paths[part].Summary();
  }
}

}  // namespace mocap
