// Ways in and out of LCM.
#pragma once

#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "config/lcm_url.h"

namespace mocap {

/// Opens a way to publish.
/// @throws SetupError  when there is none; without a multicast route it names the command that adds
///                     one.
std::unique_ptr<lcm::LCM> OpenLcm(const std::string& url);

/// Opens a second way to the same listeners, for a thread that comes after all other programs: LCM
/// locks a connection while it sends, and whoever waits for that thread to go on waits as long.
/// Empty for what has one way alone: a server, a log, this process. @throws SetupError
std::unique_ptr<lcm::LCM> OpenLcmBeside(const std::string& url);

/// Looks whether OpenLcm would succeed, and leaves no file and no message. @throws SetupError
void CheckLcm(const std::string& url);

/// What to tell a person where nothing is heard at an address.
std::string SilenceText(const std::string& url);

/// Whether the kernel knows where to send LCM's multicast.
bool HasMulticastRoute();

/// Whether a server accepts connections there. Waits for a second at most.
bool TcpServerAnswers(const LcmUrl& address);

}  // namespace mocap
