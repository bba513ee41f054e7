// What a refusal says.
#pragma once

#include <functional>
#include <string>

#include "core/errors.h"

namespace mocap::testing {

/// The words of the SetupError that an action throws.
inline std::string SetupErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace mocap::testing
