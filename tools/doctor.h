// mocap doctor: finds problems of this machine that impair motion capture, with their remedies.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddDoctorCommand(CLI::App& app);

}  // namespace mocap
