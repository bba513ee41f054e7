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

/// Opens a connection for receiving.
/// @throws SetupError  as OpenLcm, and with the text of ReceiveFault.
std::unique_ptr<lcm::LCM> OpenLcmToListen(const std::string& url);

/// Says why nothing can be received on a multicast address: its port belongs to another program, or
/// to root. Asks the kernel as LCM does, which would print an error without an address. Empty: it
/// can.
std::string ReceiveFault(const LcmUrl& address);

/// Opens a second connection to the same listeners, for a thread of low priority. LCM locks a
/// connection while it sends, so a shared one would make others wait for that thread. Null if only
/// one is possible: a server, a log, this process. @throws SetupError
std::unique_ptr<lcm::LCM> OpenLcmBeside(const std::string& url);

/// Checks whether OpenLcm would succeed; leaves no file and no message. @throws SetupError
void CheckLcm(const std::string& url);

/// Whether the kernel has a route for LCM's multicast.
bool HasMulticastRoute();

/// Whether a server accepts connections there. Waits for at most a second.
bool TcpServerAnswers(const LcmUrl& address);

}  // namespace mocap
