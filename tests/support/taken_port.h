// A UDP port that belongs to another program.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>
#include <string>

#include "core/errors.h"
#include "daemon/base/file_descriptor.h"

namespace mocap::testing {

/// Holds a free port without sharing it, as programs do that know nothing of multicast.
class TakenPort {
 public:
  TakenPort() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    sockaddr place{};
    std::memcpy(&place, &here, sizeof here);
    socklen_t size = sizeof place;
    MOCAP_CHECK(bind(fd_.get(), &place, size) == 0);
    MOCAP_CHECK(getsockname(fd_.get(), &place, &size) == 0);
    std::memcpy(&here, &place, sizeof here);
    number_ = std::to_string(ntohs(here.sin_port));
  }

  const std::string& number() const { return number_; }
  /// LCM's default address on this port.
  std::string Url() const { return "udpm://239.255.76.67:" + number_ + "?ttl=0"; }

 private:
  FileDescriptor fd_;
  std::string number_;
};

}  // namespace mocap::testing
