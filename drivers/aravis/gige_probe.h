// Looks whether a GigE Vision camera is there, without opening it.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace mocap {

enum class GigePresence {
  kAbsent,  ///< Nobody answered in time.
  kFree,
  kHeld  ///< Some program controls it; perhaps this one.
};

/// Asks the camera for its control register. Opening a camera that is not there blocks for seconds;
/// this does not.
/// @param ip  IPv4, as "192.168.1.11".
GigePresence ProbeGigeCamera(const std::string& ip, std::chrono::milliseconds timeout);

/// The way to an address.
struct NetworkRoute {
  std::string local_ip;
  std::string interface;
  double link_mbit_s = 0;  ///< 0: unknown, as with the loopback.
};

/// Tells which of this host's interfaces leads to an address; nothing if none does.
std::optional<NetworkRoute> RouteTo(const std::string& ip);

/// Whether the text is an IPv4 address in numbers.
bool IsIpv4(const std::string& text);

}  // namespace mocap
