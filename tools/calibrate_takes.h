// The steps of `mocap calibrate` that work on takes: pan-tilt heads, health, refining.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddPanTilt(CLI::App* parent);
void AddHealth(CLI::App* parent);
void AddRefine(CLI::App* parent);

}  // namespace mocap
