// Sends messages, and records failures.
#pragma once

#include <atomic>
#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "config/lcm_url.h"

namespace mocap {

/// Result of sending since the start.
struct SendStatus {
  std::int64_t failed = 0;          ///< Messages that could not be sent.
  std::int64_t last_failed_ns = 0;  ///< By the steady clock; 0: never.
  int error = 0;                    ///< errno of the last one.
};

/// Passes messages to LCM, which reports failures only by return value. Thread-safe.
class LcmSender {
 public:
  /// @param lcm  borrowed for the sender's life.
  LcmSender(lcm::LCM& lcm, LcmProvider provider) : lcm_(lcm), provider_(provider) {}

  /// @return  whether it was sent, as far as known here.
  bool Send(const std::string& channel, const void* data, std::size_t size);
  /// Encodes and sends. @param bytes  buffer to encode into.
  template <typename Message, typename Bytes>
  bool Send(const std::string& channel, const Message& message, Bytes& bytes) {
    bytes.resize(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return Send(channel, bytes.data(), bytes.size());
  }
  SendStatus Status() const;

  /// Whether the server of "tcpq" was lost. Nothing is sent then until TryAgain: LCM would
  /// reconnect for each message, which is slow, and print three lines.
  bool is_down() const { return is_down_.load(std::memory_order_relaxed); }
  void TryAgain() { is_down_.store(false, std::memory_order_relaxed); }

 private:
  void NoteFailure(int error);

  lcm::LCM& lcm_;
  const LcmProvider provider_;
  std::atomic<bool> is_down_{false};
  std::atomic<std::int64_t> failed_{0};
  std::atomic<std::int64_t> last_failed_ns_{0};
  std::atomic<int> error_{0};
};

}  // namespace mocap
