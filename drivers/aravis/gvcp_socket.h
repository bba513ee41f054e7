// The way to a GigE Vision camera's control port.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace mocap {

/// Where cameras listen for control packets (GVCP).
inline constexpr std::uint16_t kGvcpPort = 3956;

/// A control packet's head, of commands and of answers; all numbers are in network order.
struct GvcpHead {
  std::uint16_t first = 0;  ///< A key and flags when asking, the status in an answer.
  std::uint16_t command = 0;
  std::uint16_t payload_bytes = 0;
  std::uint16_t request = 0;  ///< Chosen by who asks, not 0; the answer has the same.
};
static_assert(sizeof(GvcpHead) == 8);

/// What `first` begins with in a command, and its flags.
inline constexpr std::uint16_t kGvcpKey = 0x4200, kGvcpAnswerWanted = 0x01;

/// Speaks with one camera, beside whatever else does. Thread-bound.
class GvcpSocket {
 public:
  /// @param ip  IPv4, as "192.168.1.11". Nothing is sent.
  explicit GvcpSocket(const std::string& ip);
  ~GvcpSocket();
  GvcpSocket(const GvcpSocket&) = delete;
  GvcpSocket& operator=(const GvcpSocket&) = delete;

  /// Whether there is a way to the address.
  bool connected() const { return connected_; }
  /// Sends a command and waits for its answer; those to earlier ones are passed over.
  /// @param command  its head first; the answer's command is the next number.
  /// @param answer   filled from its head on.
  /// @return how many bytes came; nothing when none came in time.
  std::optional<std::size_t> Ask(std::span<const std::byte> command, std::span<std::byte> answer,
                                 std::chrono::milliseconds patience) const;
  /// The address of this host from which the camera is reached; empty: unknown.
  std::string local_ip() const;

 private:
  int fd_;
  bool connected_ = false;
};

}  // namespace mocap
