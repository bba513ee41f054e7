// [lcm] url: what it asks for, looked at before LCM does, which passes over most mistakes.
#pragma once

#include <cstdint>
#include <string>

namespace mocap {

enum class LcmProvider {
  kMulticast,  ///< "udpm", "mpudpm".
  kTcp,        ///< "tcpq": by way of a server.
  kFile,       ///< "file": an LCM log.
  kMemory      ///< "memq": this process alone.
};

struct LcmUrl {
  LcmProvider provider = LcmProvider::kMulticast;
  std::string host;         ///< Of kMulticast and kTcp; LCM's default where the URL has none.
  std::uint16_t port = 0;   ///< Likewise.
  std::string file;         ///< Of kFile.
  bool is_written = false;  ///< Of kFile: it is written, not read.
  double speed = 1;         ///< Of a log that is read: 0 as fast as can be.
};

/// Takes an LCM address apart.
/// @throws SetupError  that says what is wrong in it and what is wanted, without naming the key.
LcmUrl ParseLcmUrl(const std::string& url);

}  // namespace mocap
