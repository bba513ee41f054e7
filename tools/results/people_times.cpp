#include "tools/results/people_times.h"

#include <algorithm>
#include <map>

#include "core/errors.h"
#include "tools/results/export_axes.h"

namespace mocap {

std::vector<PoseRow> MomentsOf(const PeopleResults& people) {
  std::map<std::int64_t, std::int64_t> frames;  // By time.
  for (const auto& [name, result] : people) {
    for (const PoseRow& row : result.poses) frames.emplace(row.timestamp_ns, row.frame);
  }
  std::vector<PoseRow> moments;
  for (const auto& [time_ns, frame] : frames) {
    PoseRow& row = moments.emplace_back();
    row.frame = frame;
    row.timestamp_ns = time_ns;
  }
  return moments;
}

Result HoldingFirstPose(const Result& result, const std::vector<PoseRow>& moments) {
  const auto first = std::ranges::find_if(result.poses, IsTracked);
  MOCAP_CHECK(first != result.poses.end());
  Result held{result.body, {}, result.remarks};
  for (const PoseRow& moment : moments) {
    if (moment.timestamp_ns >= first->timestamp_ns) break;
    PoseRow& row = held.poses.emplace_back(*first);
    row.frame = moment.frame;
    row.timestamp_ns = moment.timestamp_ns;
  }
  held.poses.insert(held.poses.end(), first, result.poses.end());
  return held;
}

}  // namespace mocap
