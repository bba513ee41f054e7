// Whether the daemon's messages arrive.
#pragma once

#include <cstdint>

namespace mocap {

/// Messages heard lately.
struct ChannelStatus {
  bool reaches_nobody = false;  ///< Messages stay in this process.
  bool other_sender = false;    ///< Somebody else sends on the same channels.
  /// How long none of the daemon's own messages came back, though it sends them; 0: they do, or
  /// nothing is known of that.
  std::int64_t silent_ns = 0;
};

}  // namespace mocap
