// GigE Vision action commands: exposures scheduled in advance, by the camera's clock.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/aravis/gvcp_socket.h"

namespace mocap {

/// A camera obeys commands with its own device and group key whose mask shares a bit with its own.
struct GigeActionKeys {
  std::uint32_t device = 0x4d4f4341;  ///< "MOCA": other programs' actions have no effect.
  std::uint32_t group = 1;
  std::uint32_t mask = 1;
};

/// Returns a command that requests an answer (GigE Vision 2, ACTION_CMD).
/// @param request  not 0.
/// @param time_ns  by the camera's clock, which ticks in nanoseconds under PTP.
std::vector<std::byte> GigeActionCommand(std::uint16_t request, const GigeActionKeys& keys,
                                         std::int64_t time_ns);

/// A camera's answer to an action command.
enum class GigeActionAnswer {
  kScheduled,
  kLate,      ///< The time has passed.
  kNoTime,    ///< It follows no PTP master.
  kFull,      ///< No memory for more actions.
  kRefused,   ///< For another reason.
  kNoAnswer,  ///< No answer in time; the command may have arrived.
};

/// Describes the problem for people; empty: none.
std::string Describe(GigeActionAnswer answer);

/// Schedules one camera's exposures. Thread-bound.
class GigeActionSender {
 public:
  /// @param ip  IPv4 of the camera.
  explicit GigeActionSender(const std::string& ip) : socket_(ip) {}

  /// Requests an exposure and waits for the answer.
  GigeActionAnswer Schedule(std::int64_t time_ns, std::chrono::milliseconds patience);

 private:
  GvcpSocket socket_;
  std::uint16_t request_ = 0;
};

}  // namespace mocap
