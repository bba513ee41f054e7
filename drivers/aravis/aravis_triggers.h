// What starts a camera's exposures, and what tells of them to other cameras.
#pragma once

#include <arv.h>

#include <string>

#include "drivers/aravis/aravis_settings.h"

namespace mocap {

/// Sets what starts an exposure, and reads it back.
/// @param device       as a person named the camera.
/// @param trigger      as in AravisSettings; "ptp" is the camera's first action (GigeActionKeys).
/// @throws SetupError  with what the camera has, when it cannot be set.
void SetTrigger(ArvCamera* camera, const std::string& device, const std::string& trigger);

/// Makes an output of the camera tell when it exposes, and reads that back.
/// @param line         the output's name; empty: none is set.
/// @throws SetupError  likewise.
void SetStrobe(ArvCamera* camera, const std::string& device, const std::string& line);

/// A list of names that one of Aravis's functions gave, as text.
std::string JoinNames(const char** names, guint count);

}  // namespace mocap
