// Access to a GigE Vision camera's control port.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace mocap {

/// UDP port of cameras for control packets (GVCP).
inline constexpr std::uint16_t kGvcpPort = 3956;

/// Header of a control packet, command or answer; in network byte order.
struct GvcpHead {
  std::uint16_t first = 0;  ///< Key and flags in a command, status in an answer.
  std::uint16_t command = 0;
  std::uint16_t payload_bytes = 0;
  std::uint16_t request = 0;  ///< Chosen by the sender, not 0; repeated in the answer.
};
static_assert(sizeof(GvcpHead) == 8);

/// Key in `first` of a command, and a flag.
inline constexpr std::uint16_t kGvcpKey = 0x4200, kGvcpAnswerWanted = 0x01;

/// Talks to one camera, independently of other connections. Thread-bound.
class GvcpSocket {
 public:
  /// @param ip  IPv4, such as "192.168.1.11". Nothing is sent yet.
  explicit GvcpSocket(const std::string& ip);
  ~GvcpSocket();
  GvcpSocket(const GvcpSocket&) = delete;
  GvcpSocket& operator=(const GvcpSocket&) = delete;

  /// Whether there is a route to the address.
  bool connected() const { return connected_; }
  /// Sends a command and waits for its answer; ignores answers to earlier ones.
  /// @param command  begins with its header; the answer's command is the next number.
  /// @param answer   filled, starting with its header.
  /// @return the number of bytes received; empty if none came in time.
  std::optional<std::size_t> Ask(std::span<const std::byte> command, std::span<std::byte> answer,
                                 std::chrono::milliseconds patience) const;
  /// The host's address used to reach the camera; empty: unknown.
  std::string local_ip() const;

 private:
  int fd_;
  bool connected_ = false;
};

}  // namespace mocap
