// Addresses of this host's loopback interface.
#pragma once

#include <string>

namespace mocap {

/// Sees to it that the loopback interface is up and has an address, which takes root to change.
/// Addresses 127.x.y.z lead nowhere else, with or without.
/// @return whether it has it now.
bool EnsureLoopbackAddress(const std::string& ip);

/// The address that lies so many after another. @throws SetupError  for text that is no IPv4.
std::string AddressAfter(const std::string& ip, int count);

}  // namespace mocap
