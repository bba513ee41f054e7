// Adds to the thread of Aravis's camera server what it lacks.
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

/// Wakes a server's thread at once, and lets it do more than Aravis knows.
///
/// The thread is found by its control socket's address, in GLib's g_poll, for which this program
/// has one of its own.
class GigeServerThread {
 public:
  struct Extras {
    /// Called before the thread waits for packets.
    std::function<void()> before_packets;
    /// Sees a control packet before Aravis does. @return the status with which to answer; nothing:
    /// the packet is Aravis's.
    std::function<std::optional<std::uint16_t>(std::span<const std::byte>)> take;
  };

  /// @param ip      of the server that runs; IPv4.
  /// @param extras  called in the server's thread.
  GigeServerThread(const std::string& ip, Extras extras);
  /// The server has to have stopped.
  ~GigeServerThread();
  GigeServerThread(const GigeServerThread&) = delete;
  GigeServerThread& operator=(const GigeServerThread&) = delete;

  /// Lets a frame out at once. Any thread.
  void Wake();
  /// What Aravis's call of g_poll does in the server's thread.
  int Poll(pollfd* sockets, unsigned count);

 private:
  bool Takes(int socket) const;

  const in_addr_t ip_;
  const Extras extras_;
  const int wake_up_;
  /// The server looks at the clock before it looks for a trigger.
  std::atomic<std::int64_t> hurry_until_ns_{0};
};

}  // namespace mocap
