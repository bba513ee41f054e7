#include "drivers/aravis/gige_probe.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>

#include "drivers/aravis/gvcp_socket.h"

namespace mocap {
namespace {

constexpr std::uint16_t kReadRegister = 0x80;
constexpr std::uint32_t kControlPrivilege = 0x0a00;
/// Control and exclusive access.
constexpr std::uint32_t kHeldBits = 0x3;
constexpr std::uint16_t kRequest = 0x4d43;

/// Register access: the address in a request, the value in an answer.
struct RegisterPacket {
  GvcpHead head;
  std::uint32_t value = 0;
};
static_assert(sizeof(RegisterPacket) == 12);

}  // namespace

GigePresence ProbeGigeCamera(const std::string& ip, std::chrono::milliseconds timeout) {
  const RegisterPacket question{{htons(kGvcpKey | kGvcpAnswerWanted), htons(kReadRegister),
                                 htons(sizeof(kControlPrivilege)), htons(kRequest)},
                                htonl(kControlPrivilege)};
  RegisterPacket answer;
  const auto bytes = GvcpSocket(ip).Ask(std::as_bytes(std::span(&question, 1)),
                                        std::as_writable_bytes(std::span(&answer, 1)), timeout);
  if (bytes != sizeof(answer)) return GigePresence::kAbsent;
  return (ntohl(answer.value) & kHeldBits) != 0 ? GigePresence::kHeld : GigePresence::kFree;
}

std::optional<NetworkRoute> RouteTo(const std::string& ip) {
  const std::string local_ip = GvcpSocket(ip).local_ip();
  if (local_ip.empty()) return std::nullopt;
  NetworkRoute route{local_ip, "", 0};
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return route;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, freeifaddrs);
  for (const ifaddrs* entry = list; entry; entry = entry->ifa_next) {
    if (!entry->ifa_addr || entry->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in address{};
    std::memcpy(&address, entry->ifa_addr, sizeof(address));
    std::array<char, INET_ADDRSTRLEN> text{};
    inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
    if (local_ip == text.data()) route.interface = entry->ifa_name;
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
