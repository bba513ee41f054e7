// The cameras of a set that each camera is compared with.
#pragma once

#include <cstddef>

namespace mocap {

/// Limit for the number of other cameras. This many tell as much as all of a very large number, and
/// the cost per camera stays bounded.
inline constexpr std::size_t kMostOthers = 31;

/// Whether `view` is compared with another view: with all of them, or with kMostOthers that are
/// spread evenly, counted from `view` on.
constexpr bool IsOther(std::size_t other, std::size_t view, std::size_t views) {
  const std::size_t all = views - 1;
  if (other == view || all <= kMostOthers) return other != view;
  const std::size_t steps_on = other > view ? other - view - 1 : other + all - view;
  return steps_on * kMostOthers % all >= all - kMostOthers;
}

}  // namespace mocap
