// Commands that end in an orderly way when they are interrupted.
#pragma once

namespace mocap {

/// Makes SIGINT and SIGTERM request an end instead of terminating the process. A second one
/// terminates it.
void StopOnSignals();
/// Whether such a signal has come. Any thread.
bool StopAsked();
/// Ends a command whose unfinished output is then removed, if such a signal has come. Any thread.
/// @throws std::runtime_error
void EndIfStopAsked();
/// Terminates the process as the signal would have, for the shell that started it; returns if none
/// has come.
void EndBySignal();

}  // namespace mocap
