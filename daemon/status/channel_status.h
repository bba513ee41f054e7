// Whether the daemon's messages arrive.
#pragma once

#include <cstdint>
#include <string>

namespace mocap {

/// Recent observations of the message channels.
struct ChannelStatus {
  bool reaches_nobody = false;  ///< Messages stay in this process.
  /// Why this host receives no messages, although they are sent; empty: nothing is known against
  /// it.
  std::string receive_fault = {};
  bool other_sender = false;  ///< Another sender uses the same channels.
  /// How long none of the daemon's own messages came back although it sends them; 0: they do, or it
  /// is unknown.
  std::int64_t silent_ns = 0;
};

}  // namespace mocap
