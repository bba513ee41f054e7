// Whether the daemon's messages arrive.
#pragma once

#include <cstdint>

namespace mocap {

/// Recent observations of the message channels.
struct ChannelStatus {
  bool reaches_nobody = false;  ///< Messages stay in this process.
  bool other_sender = false;    ///< Another sender uses the same channels.
  /// How long none of the daemon's own messages came back although it sends them; 0: they do, or it
  /// is unknown.
  std::int64_t silent_ns = 0;
};

}  // namespace mocap
