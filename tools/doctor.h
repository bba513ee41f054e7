// mocap doctor: what of this machine stands in the way of motion capture, and how to mend it.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddDoctorCommand(CLI::App& app);

}  // namespace mocap
