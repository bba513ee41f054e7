// Addresses of this host's loopback interface.
#pragma once

#include <string>

namespace mocap {

/// Ensures that the loopback interface is up and has an address; changes require root. Addresses
/// 127.x.y.z always stay on this host.
/// @return whether it has the address now.
bool EnsureLoopbackAddress(const std::string& ip);

/// Whether another program already serves a GigE Vision camera at an address of this host.
bool IsServed(const std::string& ip);

/// Returns the address `count` after another. @throws SetupError  for text that is not IPv4.
std::string AddressAfter(const std::string& ip, int count);

}  // namespace mocap
