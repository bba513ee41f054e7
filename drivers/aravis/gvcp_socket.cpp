#include "drivers/aravis/gvcp_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/errors.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

GvcpHead HeadOf(std::span<const std::byte> packet) {
  GvcpHead head;
  std::memcpy(&head, packet.data(), sizeof(head));
  return head;
}

}  // namespace

GvcpSocket::GvcpSocket(const std::string& ip) : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(kGvcpPort);
  const bool is_address = inet_pton(AF_INET, ip.c_str(), &to.sin_addr) == 1;
  connected_ = fd_ >= 0 && is_address &&
               connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0;
}

GvcpSocket::~GvcpSocket() {
  if (fd_ >= 0) close(fd_);
}

std::optional<std::size_t> GvcpSocket::Ask(std::span<const std::byte> command,
                                           std::span<std::byte> answer,
                                           milliseconds patience) const {
  MOCAP_CHECK(command.size() >= sizeof(GvcpHead) && answer.size() >= sizeof(GvcpHead));
  const auto deadline = steady_clock::now() + patience;
  if (!connected_ || send(fd_, command.data(), command.size(), 0) < 0) return std::nullopt;
  const GvcpHead asked = HeadOf(command);
  while (true) {
    // An answer that has already arrived is read even after the deadline.
    const auto rest =
        std::max(std::chrono::ceil<milliseconds>(deadline - steady_clock::now()), milliseconds(0));
    pollfd wait{fd_, POLLIN, 0};
    if (poll(&wait, 1, static_cast<int>(rest.count())) != 1) break;
    const ssize_t bytes = recv(fd_, answer.data(), answer.size(), 0);
    // The port is closed.
    if (bytes < 0) break;
    if (bytes < static_cast<ssize_t>(sizeof(GvcpHead))) continue;
    const GvcpHead head = HeadOf(answer);
    if (ntohs(head.command) == ntohs(asked.command) + 1 && head.request == asked.request) {
      return static_cast<std::size_t>(bytes);
    }
  }
  return std::nullopt;
}

std::string GvcpSocket::local_ip() const {
  sockaddr_in local{};
  socklen_t size = sizeof(local);
  if (!connected_ || getsockname(fd_, reinterpret_cast<sockaddr*>(&local), &size) != 0) return "";
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &local.sin_addr, text.data(), text.size());
  return text.data();
}

}  // namespace mocap
