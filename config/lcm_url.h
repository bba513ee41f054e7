// Checks [lcm] url before LCM does, which ignores most mistakes.
#pragma once

#include <cstdint>
#include <string>

namespace mocap {

enum class LcmProvider {
  kMulticast,  ///< "udpm", "mpudpm".
  kTcp,        ///< "tcpq": through a server.
  kFile,       ///< "file": an LCM log.
  kMemory      ///< "memq": this process only.
};

struct LcmUrl {
  LcmProvider provider = LcmProvider::kMulticast;
  std::string host;         ///< For kMulticast and kTcp; LCM's default if the URL has none.
  std::uint16_t port = 0;   ///< Likewise.
  int hops = 0;             ///< For kMulticast: its ttl. 0: messages stay on this computer.
  std::string file;         ///< For kFile.
  bool is_written = false;  ///< For kFile: written instead of read.
  double speed = 1;         ///< For reading a log: 0 is full speed.
};

/// Parses an LCM address.
/// @throws SetupError  with the error and what is expected, but without the key.
LcmUrl ParseLcmUrl(const std::string& url);

}  // namespace mocap
