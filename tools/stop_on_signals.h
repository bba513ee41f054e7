// Commands that run until interrupted.
#pragma once

namespace mocap {

/// Makes SIGINT and SIGTERM request an end instead of terminating the process.
void StopOnSignals();
/// Whether such a signal has come.
bool StopAsked();

}  // namespace mocap
