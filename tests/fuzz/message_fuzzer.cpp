#include "daemon/messages/decode_message.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  mocap::DecodeMessage<mocap::pose_t>(bytes);
  mocap::DecodeMessage<mocap::body_t>(bytes);
  mocap::DecodeMessage<mocap::people_t>(bytes);
  mocap::DecodeMessage<mocap::person_body_t>(bytes);
  mocap::DecodeMessage<mocap::person_details_t>(bytes);
  mocap::DecodeMessage<mocap::status_t>(bytes);
  mocap::DecodeMessage<mocap::service_t>(bytes);
  mocap::DecodeMessage<mocap::contrast_t>(bytes);
  mocap::DecodeMessage<mocap::studio_t>(bytes);
  mocap::DecodeMessage<mocap::preview_t>(bytes);
  mocap::DecodeMessage<mocap::unknown_t>(bytes);
  mocap::DecodeMessage<mocap::voxels_t>(bytes);
  mocap::DecodeMessage<mocap::silhouette_t>(bytes);
  mocap::DecodeMessage<mocap::node_t>(bytes);
  mocap::DecodeMessage<mocap::keypoints_t>(bytes);
  mocap::DecodeMessage<mocap::look_request_t>(bytes);
  mocap::DecodeMessage<mocap::look_t>(bytes);
  mocap::DecodeMessage<mocap::keypoint_senders_t>(bytes);
  return 0;
}
