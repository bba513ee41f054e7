#include "daemon/pipeline/moment_history.h"

#include <utility>

namespace mocap {

void MomentHistory::Add(SeenMoment moment) {
  moments_.push_back(std::move(moment));
  if (moments_.size() < kMost) return;
  for (std::size_t i = 1; 2 * i < moments_.size(); ++i) moments_[i] = std::move(moments_[2 * i]);
  moments_.resize((moments_.size() + 1) / 2);
  stride_ *= 2;
}

}  // namespace mocap
