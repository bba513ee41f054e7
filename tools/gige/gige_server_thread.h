// Extends the thread of Aravis's camera server.
#pragma once

#include <netinet/in.h>
#include <poll.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace mocap {

/// Wakes a server's thread at once, and adds features that Aravis lacks.
///
/// The thread is identified by the address of its control socket. This happens in g_poll, which
/// this program replaces.
class GigeServerThread {
 public:
  struct Extras {
    /// Called before the thread waits for packets.
    std::function<void()> before_packets;
    /// Sees a control packet before Aravis. @return the status to answer with; empty: Aravis
    /// handles the packet.
    std::function<std::optional<std::uint16_t>(std::span<const std::byte>)> take;
  };

  /// @param ip      of the running server; IPv4.
  /// @param extras  called in the server's thread.
  GigeServerThread(const std::string& ip, Extras extras);
  /// @pre  the server has stopped.
  ~GigeServerThread();
  GigeServerThread(const GigeServerThread&) = delete;
  GigeServerThread& operator=(const GigeServerThread&) = delete;

  /// Releases a frame at once. Callable from any thread.
  void Wake();
  /// Replacement for g_poll in the server's thread.
  int Poll(pollfd* sockets, unsigned count);

 private:
  bool Takes(int socket) const;

  const in_addr_t ip_;
  const Extras extras_;
  const int wake_up_;
  /// Until then the thread does not sleep: the server reads the clock before it checks for a
  /// trigger.
  std::atomic<std::int64_t> hurry_until_ns_{0};
};

}  // namespace mocap
