// Names of LCM channels as LCM's subscriptions want them.
#pragma once

#include <string>

namespace mocap {

/// LCM takes the channels of a subscription for a regular expression, in which a dot stands for
/// anything: gives one that means a text as it is.
std::string ChannelPattern(const std::string& text);

}  // namespace mocap
