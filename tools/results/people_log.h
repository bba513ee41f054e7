// Reads a log of LCM messages as results of several people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tools/results/result.h"

namespace mocap {

/// Reads MOCAP_PEOPLE, MOCAP_BODIES and MOCAP_DETAILS from a log of lcm-logger. The last body and
/// name of each person count. After a restart of the daemon, people count as new and get higher
/// numbers. People without a body, and damaged or invalid messages, are skipped; the first result's
/// remarks report this.
/// @param prefix  of the channels' names. Empty: any, if there is only one.
/// @throws SetupError  when the file is no log, or holds nobody, or people of several daemons.
PeopleResults ReadPeopleLog(const std::filesystem::path& log,
                            const std::optional<std::string>& prefix);

}  // namespace mocap
