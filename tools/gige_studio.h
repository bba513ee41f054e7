// `mocap gige-studio`: simulates a studio of GigE Vision cameras on this computer.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddGigeStudioCommand(CLI::App& app);

}  // namespace mocap
