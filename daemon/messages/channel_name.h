// Escapes names of LCM channels for subscriptions.
#pragma once

#include <string>

namespace mocap {

/// LCM treats the channel of a subscription as a regular expression, where a dot matches anything.
/// Returns a pattern that matches exactly this text.
std::string ChannelPattern(const std::string& text);

}  // namespace mocap
