// The names of a person's sizes in messages and files.
#pragma once

#include <array>
#include <string_view>

#include "core/body/body_model.h"

namespace mocap {

struct BodySizeField {
  std::string_view name;  ///< Without the unit, which is millimetres.
  double BodySizes::*value;
};

inline constexpr std::array kBodySizeFields = {
    BodySizeField{"torso", &BodySizes::torso},
    BodySizeField{"torso_width", &BodySizes::torso_width},
    BodySizeField{"torso_depth", &BodySizes::torso_depth},
    BodySizeField{"head", &BodySizes::head},
    BodySizeField{"head_width", &BodySizes::head_width},
    BodySizeField{"neck", &BodySizes::neck},
    BodySizeField{"upper_arm", &BodySizes::upper_arm},
    BodySizeField{"lower_arm", &BodySizes::lower_arm},
    BodySizeField{"thigh", &BodySizes::thigh},
    BodySizeField{"calf", &BodySizes::calf},
    BodySizeField{"upper_arm_width", &BodySizes::upper_arm_width},
    BodySizeField{"lower_arm_width", &BodySizes::lower_arm_width},
    BodySizeField{"thigh_width", &BodySizes::thigh_width},
    BodySizeField{"calf_width", &BodySizes::calf_width},
    BodySizeField{"shoulder_width", &BodySizes::shoulder_width},
    BodySizeField{"hip_width", &BodySizes::hip_width}};

}  // namespace mocap
