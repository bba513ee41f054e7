// Against which cameras of a set each of them is held.
#pragma once

#include <cstddef>

namespace mocap {

/// Of very many cameras so many tell as much as all of them, and what each is held against does not
/// grow with their number.
inline constexpr std::size_t kMostOthers = 31;

/// Whether a view is among the others that `view` is held against: all of them, or kMostOthers of
/// them, spread evenly from it on.
constexpr bool IsOther(std::size_t other, std::size_t view, std::size_t views) {
  const std::size_t all = views - 1;
  if (other == view || all <= kMostOthers) return other != view;
  const std::size_t steps_on = other > view ? other - view - 1 : other + all - view;
  return steps_on * kMostOthers % all >= all - kMostOthers;
}

}  // namespace mocap
