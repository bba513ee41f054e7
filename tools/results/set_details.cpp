#include "tools/results/set_details.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/people/people_capture.h"
#include "daemon/messages/decode_message.h"

namespace mocap {
namespace {

bool IsShare(double number) { return number >= 0 && number <= 1; }

/// Anyone may send.
bool IsSound(const person_details_t& details) {
  const bool is_probability = std::isnan(details.probability) || IsShare(details.probability);
  return is_probability && IsShare(details.rival_probability) &&
         std::ranges::all_of(details.rival_point_mm, [](const std::vector<double>& point_mm) {
           return std::ranges::all_of(point_mm, [](double mm) { return std::isfinite(mm); });
         });
}

}  // namespace

bool SetDetails::Add(std::span<const std::uint8_t> bytes) {
  std::optional<person_details_t> details = DecodeMessage<person_details_t>(bytes);
  if (!details || !IsSound(*details)) return false;
  std::erase_if(of_set_, [&](const person_details_t& before) {
    return before.utime != details->utime || before.person == details->person;
  });
  if (of_set_.size() < kMostPeople) of_set_.push_back(std::move(*details));
  return true;
}

const person_details_t* SetDetails::Of(std::int64_t utime, std::int32_t person) const {
  const auto found = std::ranges::find_if(of_set_, [&](const person_details_t& details) {
    return details.utime == utime && details.person == person;
  });
  return found == of_set_.end() ? nullptr : &*found;
}

const person_details_t* SetDetails::OfFirst(std::int64_t utime) const {
  const auto found = std::ranges::find_if(of_set_, [&](const person_details_t& details) {
    return details.utime == utime && details.place == 0;
  });
  return found == of_set_.end() ? nullptr : &*found;
}

double ToldProbability(const person_details_t* details) {
  return details ? details->probability : std::nan("");
}

}  // namespace mocap
