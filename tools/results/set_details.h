// What MOCAP_DETAILS told of the people in a frame set.
#pragma once

#include <cstdint>
#include <mocap/person_details_t.hpp>
#include <span>
#include <vector>

#include "tools/results/result.h"

namespace mocap {

/// Keeps the messages of the latest frame set. They come before the poses of the same set.
class SetDetails {
 public:
  /// Adds a message; the last one on a person counts. @return  false if it is invalid.
  bool Add(std::span<const std::uint8_t> bytes);

  /// Returns the message on a person in the set of this capture time; null: none came.
  const person_details_t* Of(std::int64_t utime, std::int32_t person) const;
  /// Likewise on the person of pose_t.
  const person_details_t* OfFirst(std::int64_t utime) const;

 private:
  std::vector<person_details_t> of_set_;  ///< Of the same utime.
};

/// Adds what a message tells beyond pose_t and person_t: the probability of the pose, the points
/// that follow the 23, and contacts with the floor. @param details  null: no message.
void ApplyDetails(const person_details_t* details, PoseRow& row);

}  // namespace mocap
