// Names of LCM channels, and their patterns for subscriptions.
#pragma once

#include <string>
#include <vector>

namespace mocap {

/// Names of channels, after the prefix.
inline constexpr const char* kPoseChannel = "MOCAP_POSE";
inline constexpr const char* kBodyChannel = "MOCAP_BODY";
inline constexpr const char* kPeopleChannel = "MOCAP_PEOPLE";
inline constexpr const char* kDetailsChannel = "MOCAP_DETAILS";
inline constexpr const char* kStatusChannel = "MOCAP_STATUS";
inline constexpr const char* kServiceChannel = "MOCAP_SERVICE";
inline constexpr const char* kContrastChannel = "MOCAP_CONTRAST";
inline constexpr const char* kBodiesChannel = "MOCAP_BODIES";
inline constexpr const char* kKeypointsChannel = "MOCAP_KEYPOINTS";
inline constexpr const char* kKeypointSendersChannel = "MOCAP_KEYPOINT_SENDERS";

/// LCM treats the channel of a subscription as a regular expression, where a dot matches anything.
/// Returns a pattern that matches exactly this text.
std::string ChannelPattern(const std::string& text);

/// Says which prefixes there are: `without a prefix`, `with prefix "left_"`, `with the prefixes
/// "left_", "right_"`, or without one and with others. At least one is wanted.
std::string PrefixPhrase(const std::vector<std::string>& prefixes);

}  // namespace mocap
