#include "tools/interchange/people_times.h"

#include <algorithm>
#include <map>

#include "core/errors.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

const PoseRow& FirstTracked(const Result& result) {
  const auto first = std::ranges::find_if(result.poses, IsTracked);
  MOCAP_CHECK(first != result.poses.end());
  return *first;
}

}  // namespace

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

double SecondsBeforeFirstPose(const Result& result, const std::vector<PoseRow>& moments) {
  return 1e-9 *
         static_cast<double>(FirstTracked(result).timestamp_ns - moments.front().timestamp_ns);
}

Result HoldingFirstPose(const Result& result, const std::vector<PoseRow>& moments) {
  const PoseRow& first = FirstTracked(result);
  Result held{result.body, {}, result.remarks};
  for (const PoseRow& moment : moments) {
    if (moment.timestamp_ns >= first.timestamp_ns) break;
    PoseRow& row = held.poses.emplace_back(first);
    row.frame = moment.frame;
    row.timestamp_ns = moment.timestamp_ns;
  }
  held.poses.insert(held.poses.end(), result.poses.begin() + (&first - result.poses.data()),
                    result.poses.end());
  return held;
}

}  // namespace mocap
