// GigE Vision's action commands: exposures that are asked for ahead, at a time of the camera's
// clock.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/aravis/gvcp_socket.h"

namespace mocap {

/// A camera acts on commands whose device and group key are its own, and whose mask shares a bit
/// with its own.
struct GigeActionKeys {
  std::uint32_t device = 0x4d4f4341;  ///< "MOCA": other programs' actions are none of ours.
  std::uint32_t group = 1;
  std::uint32_t mask = 1;
};

/// The bytes of a command that wants an answer (GigE Vision 2, ACTION_CMD).
/// @param request  not 0.
/// @param time_ns  by the camera's clock, whose ticks are nanoseconds under PTP.
std::vector<std::byte> GigeActionCommand(std::uint16_t request, const GigeActionKeys& keys,
                                         std::int64_t time_ns);

/// What a camera says of an action.
enum class GigeActionAnswer {
  kScheduled,
  kLate,      ///< The time was over.
  kNoTime,    ///< It follows no PTP master.
  kFull,      ///< It can remember no more actions.
  kRefused,   ///< For another reason.
  kNoAnswer,  ///< None came in time; the action may have been heard.
};

/// Tells people what is wrong; empty: nothing.
std::string Describe(GigeActionAnswer answer);

/// Schedules one camera's exposures. Thread-bound.
class GigeActionSender {
 public:
  /// @param ip  IPv4 of the camera.
  explicit GigeActionSender(const std::string& ip) : socket_(ip) {}

  /// Asks for an exposure and waits for the answer.
  GigeActionAnswer Schedule(std::int64_t time_ns, std::chrono::milliseconds patience);

 private:
  GvcpSocket socket_;
  std::uint16_t request_ = 0;
};

}  // namespace mocap
