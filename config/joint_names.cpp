#include "config/joint_names.h"

#include <algorithm>

namespace mocap {

bool IsJointName(std::string_view name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && std::ranges::all_of(name, is_letter) && !name.starts_with("theta_") &&
         name != "torso_angle";
}

}  // namespace mocap
