#include "tools/gige/loopback.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>

#include "core/errors.h"
#include "daemon/base/file_descriptor.h"
#include "drivers/aravis/gvcp_socket.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

std::uint32_t Parse(const std::string& ip) {
  in_addr address{};
  if (inet_pton(AF_INET, ip.c_str(), &address) != 1) {
    throw SetupError(Quoted(ip) + " is not an IPv4 address, such as 127.0.0.11");
  }
  return ntohl(address.s_addr);
}

bool HasAddress(std::uint32_t ip) {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return false;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, freeifaddrs);
  for (const ifaddrs* entry = list; entry; entry = entry->ifa_next) {
    if (!entry->ifa_addr || entry->ifa_addr->sa_family != AF_INET) continue;
    if ((entry->ifa_flags & IFF_UP) == 0) continue;
    sockaddr_in address{};
    std::memcpy(&address, entry->ifa_addr, sizeof(address));
    if (ntohl(address.sin_addr.s_addr) == ip) return true;
  }
  return false;
}

void SetName(ifreq& request, const std::string& name) { name.copy(request.ifr_name, IFNAMSIZ - 1); }

void SetAddress(ifreq& request, std::uint32_t ip) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(ip);
  std::memcpy(&request.ifr_addr, &address, sizeof(address));
}

}  // namespace

bool EnsureLoopbackAddress(const std::string& ip) {
  const std::uint32_t wanted = Parse(ip);
  if (HasAddress(wanted)) return true;
  if (wanted >> 24 != IN_LOOPBACKNET) return false;
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return false;
  ifreq up{};
  SetName(up, "lo");
  if (ioctl(fd, SIOCGIFFLAGS, &up) == 0 && (up.ifr_flags & IFF_UP) == 0) {
    up.ifr_flags |= IFF_UP;
    ioctl(fd, SIOCSIFFLAGS, &up);
  }
  ifreq alias{};
  SetName(alias, "lo:" + std::to_string(wanted & 0xffffff));
  SetAddress(alias, wanted);
  ioctl(fd, SIOCSIFADDR, &alias);
  ifreq mask{};
  SetName(mask, alias.ifr_name);
  SetAddress(mask, 0xff000000);
  ioctl(fd, SIOCSIFNETMASK, &mask);
  close(fd);
  return HasAddress(wanted);
}

bool IsServed(const std::string& ip) {
  const FileDescriptor fd(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(kGvcpPort);
  here.sin_addr.s_addr = htonl(Parse(ip));
  sockaddr place{};
  std::memcpy(&place, &here, sizeof(here));
  // Aravis shares the port, even with another that serves the same camera.
  return bind(fd.get(), &place, sizeof(place)) != 0 && errno == EADDRINUSE;
}

std::string AddressAfter(const std::string& ip, int count) {
  in_addr address{};
  address.s_addr = htonl(Parse(ip) + static_cast<std::uint32_t>(count));
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &address, text.data(), text.size());
  return text.data();
}

}  // namespace mocap
