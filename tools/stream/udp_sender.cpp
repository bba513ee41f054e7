#include "tools/stream/udp_sender.h"

#include <netdb.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "core/errors.h"

namespace mocap {

UdpSender::UdpSender(const std::string& host, const std::string& port) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found); error != 0) {
    throw SetupError(gai_strerror(error));
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> places(found, &freeaddrinfo);
  const addrinfo* chosen = found;
  for (const addrinfo* place = found; place; place = place->ai_next) {
    if (chosen->ai_family != AF_INET && place->ai_family == AF_INET) chosen = place;
  }
  std::memcpy(&place_, chosen->ai_addr, chosen->ai_addrlen);
  place_size_ = chosen->ai_addrlen;
  fd_ = FileDescriptor(socket(chosen->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!fd_.valid()) throw SetupError(std::strerror(errno));
  const int may_broadcast = 1;
  setsockopt(fd_.get(), SOL_SOCKET, SO_BROADCAST, &may_broadcast, sizeof may_broadcast);
}

std::string UdpSender::Send(std::span<const char> bytes) const {
  const auto* const to = reinterpret_cast<const sockaddr*>(&place_);
  const ssize_t sent = sendto(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL, to, place_size_);
  return sent < 0 ? std::strerror(errno) : "";
}

}  // namespace mocap
