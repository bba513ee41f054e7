// Opens LCM connections.
#pragma once

#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "config/lcm_url.h"

namespace mocap {

/// Opens a connection for publishing.
/// @throws SetupError  if none is possible. Without a multicast route it names the command that
/// adds one.
std::unique_ptr<lcm::LCM> OpenLcm(const std::string& url);

/// Opens a second connection to the same listeners, for a thread of low priority. LCM locks a
/// connection while it sends, so a shared one would make others wait for that thread. Null if only
/// one is possible: a server, a log, this process. @throws SetupError
std::unique_ptr<lcm::LCM> OpenLcmBeside(const std::string& url);

/// Checks whether OpenLcm would succeed; leaves no file and no message. @throws SetupError
void CheckLcm(const std::string& url);

/// The message for a person if nothing is heard at an address.
std::string SilenceText(const std::string& url);

/// Whether the kernel has a route for LCM's multicast.
bool HasMulticastRoute();

/// Whether a server accepts connections there. Waits for at most a second.
bool TcpServerAnswers(const LcmUrl& address);

}  // namespace mocap
