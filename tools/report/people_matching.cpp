#include "tools/report/people_matching.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace mocap {
namespace {

constexpr int kNobody = -1, kNone = -1;

/// Half the shortest time between any person's frames: beyond it, frames are different.
std::int64_t ToleranceNs(std::span<const std::vector<ScoredFrame>> truth) {
  std::int64_t least_ns = std::numeric_limits<std::int64_t>::max();
  for (const std::vector<ScoredFrame>& frames : truth) {
    for (std::size_t i = 1; i < frames.size(); ++i) {
      least_ns = std::min(least_ns, frames[i].timestamp_ns - frames[i - 1].timestamp_ns);
    }
  }
  return least_ns == std::numeric_limits<std::int64_t>::max() ? 0 : least_ns / 2;
}

std::optional<int> FrameAt(const std::vector<ScoredFrame>& frames, std::int64_t time_ns,
                           std::int64_t tolerance_ns) {
  const auto after =
      std::ranges::lower_bound(frames, time_ns - tolerance_ns, {}, &ScoredFrame::timestamp_ns);
  std::optional<int> nearest;
  std::int64_t least_ns = tolerance_ns;
  for (auto frame = after; frame != frames.end(); ++frame) {
    const std::int64_t apart_ns = std::abs(frame->timestamp_ns - time_ns);
    if (apart_ns > least_ns) break;
    least_ns = apart_ns;
    nearest = static_cast<int>(frame - frames.begin());
  }
  return nearest;
}

/// A possible match of a tracked and a true person in a frame.
struct Candidate {
  std::size_t tracked = 0;
  PersonMatch match;
  bool was_the_same = false;
};

class Matcher {
 public:
  Matcher(std::span<const std::vector<ScoredFrame>> truth,
          std::span<const std::vector<ScoredFrame>> tracked)
      : truth_(truth),
        tracked_(tracked),
        tolerance_ns_(ToleranceNs(truth)),
        people_(tracked.size()),
        last_(tracked.size(), kNobody),
        found_(truth.size(), kNone) {}

  std::vector<MatchedPerson> Match() {
    std::map<std::int64_t, std::vector<Candidate>> moments;
    for (std::size_t i = 0; i < tracked_.size(); ++i) {
      for (std::size_t pose = 0; pose < tracked_[i].size(); ++pose) {
        if (!tracked_[i][pose].tracked) continue;
        AddCandidates(i, static_cast<int>(pose), moments[tracked_[i][pose].timestamp_ns]);
      }
    }
    for (auto& [time_ns, candidates] : moments) Choose(candidates);
    return std::move(people_);
  }

 private:
  void AddCandidates(std::size_t tracked, int pose, std::vector<Candidate>& candidates) const {
    const ScoredFrame& output = tracked_[tracked][static_cast<std::size_t>(pose)];
    for (std::size_t person = 0; person < truth_.size(); ++person) {
      const auto frame = FrameAt(truth_[person], output.timestamp_ns, tolerance_ns_);
      if (!frame) continue;
      const ScoredFrame& truth = truth_[person][static_cast<std::size_t>(*frame)];
      const double mean_mm = (output.points_W - truth.points_W).colwise().norm().mean();
      if (mean_mm > kSamePersonMm) continue;
      candidates.push_back({tracked, {pose, static_cast<int>(person), *frame, mean_mm}});
    }
  }

  void Choose(std::vector<Candidate>& candidates) {
    for (Candidate& candidate : candidates) {
      candidate.was_the_same = last_[candidate.tracked] == candidate.match.person;
    }
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
      if (a.was_the_same != b.was_the_same) return a.was_the_same;
      return a.match.mean_mm < b.match.mean_mm;
    });
    std::set<std::size_t> near, used;
    for (const Candidate& candidate : candidates) {
      near.insert(candidate.tracked);
      // Moments are in order of time: a later one may match the same frame, but never an earlier
      // one.
      int& found = found_[static_cast<std::size_t>(candidate.match.person)];
      if (used.contains(candidate.tracked) || candidate.match.frame <= found) continue;
      used.insert(candidate.tracked);
      found = candidate.match.frame;
      people_[candidate.tracked].matches.push_back(candidate.match);
      last_[candidate.tracked] = candidate.match.person;
    }
    for (const std::size_t tracked : near) {
      people_[tracked].duplicates += !used.contains(tracked);
    }
  }

  const std::span<const std::vector<ScoredFrame>> truth_, tracked_;
  const std::int64_t tolerance_ns_;
  std::vector<MatchedPerson> people_;
  std::vector<int> last_;   ///< Last match of each tracked person.
  std::vector<int> found_;  ///< Last matched frame of each true person.
};

}  // namespace

std::vector<MatchedPerson> MatchPeople(std::span<const std::vector<ScoredFrame>> truth,
                                       std::span<const std::vector<ScoredFrame>> tracked) {
  return Matcher(truth, tracked).Match();
}

}  // namespace mocap
