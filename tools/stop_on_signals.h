// Commands that go on until somebody ends them.
#pragma once

namespace mocap {

/// From now on SIGINT and SIGTERM ask for an end instead of making one.
void StopOnSignals();
/// Whether one has come.
bool StopAsked();

}  // namespace mocap
