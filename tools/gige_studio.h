// `mocap gige-studio`: a studio of GigE Vision cameras that exist in this computer only.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddGigeStudioCommand(CLI::App& app);

}  // namespace mocap
