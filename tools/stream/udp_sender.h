// Datagrams to one receiver.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <span>
#include <string>

#include "daemon/base/file_descriptor.h"

namespace mocap {

/// Sends datagrams to a host of IPv4 or IPv6. A name that is both is reached by IPv4, which most
/// receivers listen to.
class UdpSender {
 public:
  /// @throws SetupError  with the reason, when the host is not known.
  UdpSender(const std::string& host, const std::string& port);

  /// Sends one datagram. @return  why it could not be sent; empty: it was.
  std::string Send(std::span<const char> bytes) const;

 private:
  FileDescriptor fd_;
  sockaddr_storage place_{};
  socklen_t place_size_ = 0;
};

}  // namespace mocap
