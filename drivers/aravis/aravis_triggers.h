// Trigger inputs and strobe outputs of a camera.
#pragma once

#include <arv.h>

#include <string>

#include "drivers/aravis/aravis_settings.h"

namespace mocap {

/// Sets what starts an exposure, and reads it back.
/// @param device       name of the camera, given by the user.
/// @param trigger      as in AravisSettings; "ptp" is the camera's first action (GigeActionKeys).
/// @throws SetupError  listing the available sources, when it cannot be set.
void SetTrigger(ArvCamera* camera, const std::string& device, const std::string& trigger);

/// Makes an output of the camera signal its exposures, and reads it back.
/// @param line         the output's name; empty: none is set.
/// @throws SetupError  listing the available sources, when it cannot be set.
void SetStrobe(ArvCamera* camera, const std::string& device, const std::string& line);

/// Joins a list of names from an Aravis function.
std::string JoinNames(const char** names, guint count);

}  // namespace mocap
