#include "core/people/keypoint_division.h"

#include <algorithm>
#include <optional>

#include "core/objective/keypoint_term.h"
#include "core/reconstruction/silhouette/line_range.h"

namespace mocap {
namespace {

std::optional<std::size_t> PersonOf(const KeypointRays& view, std::span<const PosedBody> people) {
  std::optional<std::size_t> cheapest;
  double least = 0;
  for (std::size_t i = 0; i < people.size(); ++i) {
    if (KeypointTerm::ProbabilityOfElsewhere(view, people[i]) > 0.5) continue;
    const double nats = KeypointTerm::NatsOf(view, people[i]);
    if (cheapest && nats >= least) continue;
    cheapest = i;
    least = nats;
  }
  return cheapest;
}

std::ptrdiff_t RaysThrough(const Eigen::AlignedBox3d& box_W, const KeypointRays& view) {
  return std::ranges::count_if(view.rays, [&](const KeypointRay& ray) {
    return RangeWithin(box_W, ray.eye_W, ray.direction_W).has_value();
  });
}

std::optional<std::size_t> StrangerOf(const KeypointRays& view,
                                      std::span<const Eigen::AlignedBox3d> strangers) {
  std::optional<std::size_t> fullest;
  std::ptrdiff_t most = std::ssize(view.rays) / 2;
  for (std::size_t i = 0; i < strangers.size(); ++i) {
    const std::ptrdiff_t rays = RaysThrough(strangers[i], view);
    if (rays <= most) continue;
    fullest = i;
    most = rays;
  }
  return fullest;
}

}  // namespace

void KeypointDivision::Divide(std::span<const KeypointRays> views,
                              std::span<const PosedBody> people,
                              std::span<const Eigen::AlignedBox3d> strangers) {
  shares_.resize(people.size() + strangers.size());
  for (std::vector<KeypointRays>& share : shares_) share.clear();
  for (const KeypointRays& view : views) {
    if (const auto person = PersonOf(view, people)) {
      shares_[*person].push_back(view);
    } else if (const auto stranger = StrangerOf(view, strangers)) {
      shares_[people.size() + *stranger].push_back(view);
    }
  }
}

}  // namespace mocap
