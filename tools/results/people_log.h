// A log of LCM messages as results of several people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tools/results/result.h"

namespace mocap {

/// Reads MOCAP_PEOPLE and MOCAP_BODIES out of what lcm-logger recorded; of each person the last
/// body and name count. Whom a daemon follows after it was started again is somebody else, with a
/// number above all before. Who has no body, and what is damaged or not understood, is passed over,
/// and remarks of the first person's result tell.
/// @param prefix  before the channels' names. Empty: whatever it is, if it is one.
/// @throws SetupError  when the file is no log, or holds nobody, or people of several daemons.
PeopleResults ReadPeopleLog(const std::filesystem::path& log,
                            const std::optional<std::string>& prefix);

}  // namespace mocap
