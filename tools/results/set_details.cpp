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
  const auto is_valid = [](double number) { return !std::isinf(number); };
  const bool are_points = std::ranges::all_of(details.point_std_mm, is_valid) &&
                          std::ranges::all_of(details.point_mm, [&](const auto& point_mm) {
                            return std::ranges::all_of(point_mm, is_valid);
                          });
  const bool is_probability = std::isnan(details.probability) || IsShare(details.probability);
  return are_points && is_probability && std::ranges::all_of(details.contact, IsShare) &&
         IsShare(details.rival_probability) &&
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

void ApplyDetails(const person_details_t* details, PoseRow& row) {
  if (!details) return;
  row.probability = details->probability;
  for (int i = 0; i < kFurtherPointCount; ++i) {
    const auto name = std::ranges::find(details->point_name, kFurtherPointNames[i]);
    if (name == details->point_name.end()) continue;
    const auto place = static_cast<std::size_t>(name - details->point_name.begin());
    row.further_W.col(i) = Vector3(details->point_mm[place].data());
    row.further_std_mm[i] = details->point_std_mm[place];
  }
  for (int i = 0; i < kContactCount; ++i) {
    const auto name = std::ranges::find(details->contact_name, kContactNames[i]);
    if (name == details->contact_name.end()) continue;
    row.contacts[i] = details->contact[name - details->contact_name.begin()];
  }
}

}  // namespace mocap
