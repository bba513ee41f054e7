#include "drivers/aravis/gige_probe.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>

namespace mocap {
namespace {

constexpr std::uint16_t kControlPort = 3956;
constexpr std::uint16_t kReadRegister = 0x80, kReadRegisterAnswer = 0x81;
constexpr std::uint32_t kControlPrivilege = 0x0a00;
/// Control, and exclusive access.
constexpr std::uint32_t kHeldBits = 0x3;
constexpr std::uint16_t kRequest = 0x4d43;

class Socket {
 public:
  explicit Socket(const std::string& ip) : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(kControlPort);
    const bool is_address = inet_pton(AF_INET, ip.c_str(), &to.sin_addr) == 1;
    connected_ = fd_ >= 0 && is_address &&
                 connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0;
  }
  ~Socket() {
    if (fd_ >= 0) close(fd_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  int fd() const { return fd_; }
  bool connected() const { return connected_; }

 private:
  int fd_;
  bool connected_ = false;
};

/// Eight bytes of head, then one number; all in network order.
struct ControlPacket {
  std::uint16_t first = 0;  ///< A key and flags when asking, the status in an answer.
  std::uint16_t command = 0;
  std::uint16_t payload_bytes = 0;
  std::uint16_t request = 0;
  std::uint32_t value = 0;
};
static_assert(sizeof(ControlPacket) == 12);

}  // namespace

GigePresence ProbeGigeCamera(const std::string& ip, std::chrono::milliseconds timeout) {
  const Socket socket(ip);
  if (!socket.connected()) return GigePresence::kAbsent;
  constexpr std::uint16_t kKeyAndAnswerWanted = 0x4201;
  const ControlPacket question{htons(kKeyAndAnswerWanted), htons(kReadRegister),
                               htons(sizeof(kControlPrivilege)), htons(kRequest),
                               htonl(kControlPrivilege)};
  if (send(socket.fd(), &question, sizeof(question), 0) != sizeof(question)) {
    return GigePresence::kAbsent;
  }
  pollfd wait{socket.fd(), POLLIN, 0};
  ControlPacket answer;
  if (poll(&wait, 1, static_cast<int>(timeout.count())) != 1 ||
      recv(socket.fd(), &answer, sizeof(answer), 0) != sizeof(answer) ||
      ntohs(answer.command) != kReadRegisterAnswer || ntohs(answer.request) != kRequest) {
    return GigePresence::kAbsent;
  }
  return (ntohl(answer.value) & kHeldBits) != 0 ? GigePresence::kHeld : GigePresence::kFree;
}

std::optional<NetworkRoute> RouteTo(const std::string& ip) {
  const Socket socket(ip);
  sockaddr_in local{};
  socklen_t size = sizeof(local);
  if (!socket.connected() ||
      getsockname(socket.fd(), reinterpret_cast<sockaddr*>(&local), &size) != 0) {
    return std::nullopt;
  }
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &local.sin_addr, text.data(), text.size());
  NetworkRoute route{text.data(), "", 0};
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return route;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, freeifaddrs);
  for (const ifaddrs* entry = list; entry; entry = entry->ifa_next) {
    if (!entry->ifa_addr || entry->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in address{};
    std::memcpy(&address, entry->ifa_addr, sizeof(address));
    if (address.sin_addr.s_addr == local.sin_addr.s_addr) route.interface = entry->ifa_name;
  }
  double speed = 0;
  if (std::ifstream("/sys/class/net/" + route.interface + "/speed") >> speed && speed > 0) {
    route.link_mbit_s = speed;
  }
  return route;
}

bool IsIpv4(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

}  // namespace mocap
