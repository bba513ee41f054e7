// Decodes messages from the network, which may contain anything.
#pragma once

#include <cstdint>
#include <limits>
#include <mocap/body_t.hpp>
#include <mocap/contrast_t.hpp>
#include <mocap/keypoint_senders_t.hpp>
#include <mocap/keypoints_t.hpp>
#include <mocap/look_request_t.hpp>
#include <mocap/look_t.hpp>
#include <mocap/node_t.hpp>
#include <mocap/people_t.hpp>
#include <mocap/person_body_t.hpp>
#include <mocap/person_details_t.hpp>
#include <mocap/pose_t.hpp>
#include <mocap/preview_t.hpp>
#include <mocap/service_t.hpp>
#include <mocap/silhouette_t.hpp>
#include <mocap/status_t.hpp>
#include <mocap/studio_t.hpp>
#include <mocap/unknown_t.hpp>
#include <mocap/voxels_t.hpp>
#include <optional>
#include <span>

namespace mocap {

/// Whether the lengths and counts in a message fit into its bytes. Generated decoders trust a count
/// and allocate memory for it before they check whether data follows.
bool HasSoundCounts(const pose_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const body_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const people_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const person_body_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const person_details_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const status_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const service_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const contrast_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const studio_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const preview_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const unknown_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const voxels_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const silhouette_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const keypoints_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const keypoint_senders_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const look_request_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const look_t& kind, std::span<const std::uint8_t> bytes);
bool HasSoundCounts(const node_t& kind, std::span<const std::uint8_t> bytes);

/// Decodes a message; empty if it is not a valid one of this type.
template <typename Message>
std::optional<Message> DecodeMessage(std::span<const std::uint8_t> bytes) {
  std::optional<Message> message(std::in_place);
  if (bytes.size() > std::numeric_limits<int>::max() || !HasSoundCounts(*message, bytes)) return {};
  if (message->decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return {};
  return message;
}

}  // namespace mocap
