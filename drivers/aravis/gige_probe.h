// Checks whether a GigE Vision camera is present, without opening it.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace mocap {

enum class GigePresence {
  kAbsent,  ///< No answer in time.
  kFree,
  kHeld  ///< Controlled by some program, perhaps this one.
};

/// Reads a camera's control register. Unlike opening, this does not block for seconds when the
/// camera is gone.
/// @param ip  IPv4, such as "192.168.1.11".
GigePresence ProbeGigeCamera(const std::string& ip, std::chrono::milliseconds timeout);

/// The route to an address.
struct NetworkRoute {
  std::string local_ip;
  std::string interface;
  double link_mbit_s = 0;  ///< 0: unknown, as for the loopback.
};

/// Returns this host's interface that leads to an address; empty if none does.
std::optional<NetworkRoute> RouteTo(const std::string& ip);

/// Whether the text is a numeric IPv4 address.
bool IsIpv4(const std::string& text);

}  // namespace mocap
