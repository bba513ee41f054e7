#include "tools/gige/gige_server_thread.h"

#include <arpa/inet.h>
#include <glib.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>

#include "core/errors.h"
#include "drivers/aravis/gvcp_socket.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr std::size_t kMostSockets = 7;
constexpr std::size_t kLargestPacket = 576;
constexpr timespec kBriefly{0, 50'000}, kAWhile{0, 20'000'000};

std::mutex servers_mutex;
std::map<in_addr_t, GigeServerThread*>& Servers() {
  static std::map<in_addr_t, GigeServerThread*> servers;
  return servers;
}

/// The server that runs in this thread, once known.
thread_local GigeServerThread* this_server = nullptr;

GigeServerThread* FindServer(std::span<const pollfd> sockets) {
  const std::lock_guard lock(servers_mutex);
  if (Servers().empty()) return nullptr;
  for (const pollfd& one : sockets) {
    sockaddr_in at{};
    socklen_t size = sizeof(at);
    if (getsockname(one.fd, reinterpret_cast<sockaddr*>(&at), &size) != 0) continue;
    if (at.sin_family != AF_INET || ntohs(at.sin_port) != kGvcpPort) continue;
    const auto server = Servers().find(at.sin_addr.s_addr);
    if (server != Servers().end()) return server->second;
  }
  return nullptr;
}

}  // namespace

GigeServerThread::GigeServerThread(const std::string& ip, Extras extras)
    : ip_(inet_addr(ip.c_str())),
      extras_(std::move(extras)),
      wake_up_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  MOCAP_CHECK(wake_up_ >= 0);
  const std::lock_guard lock(servers_mutex);
  Servers()[ip_] = this;
}

GigeServerThread::~GigeServerThread() {
  {
    const std::lock_guard lock(servers_mutex);
    Servers().erase(ip_);
  }
  close(wake_up_);
}

void GigeServerThread::Wake() {
  hurry_until_ns_.store(TimelineNs() + 2'000'000);
  const std::uint64_t one = 1;
  static_cast<void>(!write(wake_up_, &one, sizeof(one)));
}

int GigeServerThread::Poll(pollfd* sockets, unsigned count) {
  extras_.before_packets();
  std::array<pollfd, kMostSockets + 1> all{};
  MOCAP_CHECK(count < all.size());
  std::copy_n(sockets, count, all.begin());
  all[count] = {wake_up_, POLLIN, 0};
  const bool hurries = TimelineNs() < hurry_until_ns_.load();
  int ready = ppoll(all.data(), count + 1, hurries ? &kBriefly : &kAWhile, nullptr);
  std::copy_n(all.begin(), count, sockets);
  if (ready <= 0) return ready;
  if (all[count].revents != 0) {
    --ready;
    std::uint64_t wakes = 0;
    static_cast<void>(!read(wake_up_, &wakes, sizeof(wakes)));
  }
  for (pollfd& one : std::span(sockets, count)) {
    if ((one.revents & POLLIN) == 0 || !Takes(one.fd)) continue;
    one.revents = 0;
    --ready;
  }
  return ready;
}

bool GigeServerThread::Takes(int socket) const {
  std::array<std::byte, kLargestPacket> packet;
  sockaddr_in from{};
  socklen_t size = sizeof(from);
  const ssize_t bytes = recvfrom(socket, packet.data(), packet.size(), MSG_PEEK | MSG_DONTWAIT,
                                 reinterpret_cast<sockaddr*>(&from), &size);
  if (bytes < static_cast<ssize_t>(sizeof(GvcpHead))) return false;
  const auto status = extras_.take(std::span(packet).first(static_cast<std::size_t>(bytes)));
  if (!status) return false;
  recv(socket, packet.data(), packet.size(), MSG_DONTWAIT);
  GvcpHead head;
  std::memcpy(&head, packet.data(), sizeof(head));
  const GvcpHead answer{htons(*status), htons(static_cast<std::uint16_t>(ntohs(head.command) + 1)),
                        0, head.request};
  sendto(socket, &answer, sizeof(answer), 0, reinterpret_cast<const sockaddr*>(&from), size);
  return true;
}

}  // namespace mocap

/// Replaces GLib's g_poll in Aravis. The server's thread computes its sleep time in unsigned
/// numbers (up to 0.8.26 at least). It sleeps for 100 ms when late, and spins when early. Other
/// threads get the usual behaviour.
extern "C" gint g_poll(GPollFD* fds, guint count, gint timeout_ms) {
  static_assert(sizeof(GPollFD) == sizeof(pollfd));
  auto* sockets = reinterpret_cast<pollfd*>(fds);
  mocap::GigeServerThread*& server = mocap::this_server;
  if (!server && count <= mocap::kMostSockets) server = mocap::FindServer({sockets, count});
  return server ? server->Poll(sockets, count) : poll(sockets, count, timeout_ms);
}
