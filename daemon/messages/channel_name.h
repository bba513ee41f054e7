// Names of LCM channels, and their patterns for subscriptions.
#pragma once

#include <string>

namespace mocap {

/// Names of channels, after the prefix.
inline constexpr const char* kPoseChannel = "MOCAP_POSE";
inline constexpr const char* kBodyChannel = "MOCAP_BODY";
inline constexpr const char* kPeopleChannel = "MOCAP_PEOPLE";
inline constexpr const char* kStatusChannel = "MOCAP_STATUS";
inline constexpr const char* kBodiesChannel = "MOCAP_BODIES";

/// LCM treats the channel of a subscription as a regular expression, where a dot matches anything.
/// Returns a pattern that matches exactly this text.
std::string ChannelPattern(const std::string& text);

}  // namespace mocap
